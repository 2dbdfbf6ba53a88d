"use strict";
// One controller on one linear plant in wind, by the equations of the program (plant/antenna,
// plant/wind, control/controllers, control/loops): frequency responses, spectra and state space.
// SI at the motor shaft, rad and rad/s; nothing here knows a document.
//
//   data     what is on the page (io/description/adjustable_loop_description.hpp)
//   setting  { oil_stiffness, leakage_rate, viscous_friction, wind_speed }
//   gains    in the order of the blocks
const LoopModel = (() => {
  // Complex numbers.
  const complex = (re, im) => ({ re, im });
  const one = complex(1, 0);
  const add = (x, y) => complex(x.re + y.re, x.im + y.im);
  const subtract = (x, y) => complex(x.re - y.re, x.im - y.im);
  const multiply = (x, y) => complex(x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re);
  const times = (factor, x) => complex(factor * x.re, factor * x.im);
  const square = (x) => x.re * x.re + x.im * x.im;
  const magnitude = (x) => Math.sqrt(square(x));
  const inverse = (x) => times(1 / square(x), complex(x.re, -x.im));

  // -- Plant ---------------------------------------------------------------------------------------

  const numbersOf = (data, setting) => {
    const { drive, antenna } = data;
    return {
      K: setting.oil_stiffness, lambda: setting.leakage_rate, Bf: setting.viscous_friction,
      Jm: drive.motor_inertia_kg_m2, wv: drive.valve_corner_rad_per_s, zv: drive.valve_damping_1,
      wt: drive.tachometer_corner_rad_per_s,
      Jb: antenna.bull_gear_inertia_kg_m2, kg: antenna.gear_stiffness_N_m_per_rad,
      cg: antenna.gear_damping_N_m_s_per_rad, wind: antenna.bull_gear_wind_fraction_1,
      beam: antenna.bull_gear_beam_weight_1,
      modes: antenna.modes.map((mode) => ({
        J: mode.inertia_kg_m2, k: mode.stiffness_N_m_per_rad, c: mode.damping_N_m_s_per_rad,
        wind: mode.wind_fraction_1, beam: mode.beam_weight_1,
      })),
    };
  };

  // From valve command and wind torque to tachometer, motor torque, encoder and boresight.
  const responseAt = (plant, w) => {
    let inertial = complex(-plant.Jb * w * w, 0), wind = complex(plant.wind, 0), beam = complex(plant.beam, 0), bending = complex(0, 0);
    for (const mode of plant.modes) {
      const flexibility = inverse(complex(mode.k - mode.J * w * w, mode.c * w));
      const follow = multiply(complex(mode.k, mode.c * w), flexibility);
      inertial = subtract(inertial, times(mode.J * w * w, follow));
      wind = add(wind, times(mode.wind, follow));
      beam = add(beam, times(mode.beam, follow));
      bending = add(bending, times(mode.wind * mode.beam, flexibility));
    }
    const s = complex(0, w), wv2 = plant.wv * plant.wv;
    const valve = times(wv2, inverse(complex(wv2 - w * w, 2 * plant.zv * plant.wv * w)));
    const oil = times(plant.K, inverse(complex(plant.lambda, w)));
    const own = complex(-plant.Jm * w * w, plant.Bf * w);
    const a = add(own, multiply(oil, s)), g = complex(plant.kg, plant.cg * w), b = inertial;
    const inverse_det = inverse(add(multiply(g, add(a, b)), multiply(a, b)));
    const push = multiply(multiply(oil, valve), inverse_det);
    const blow = multiply(wind, inverse_det);
    const rate = multiply(s, times(plant.wt, inverse(complex(plant.wt, w))));
    const gb = add(g, b), encoder_command = multiply(g, push), encoder_wind = multiply(add(g, a), blow);
    return {
      tachometer_command: multiply(multiply(rate, gb), push),
      torque_command: multiply(add(multiply(own, gb), multiply(g, b)), push),
      encoder_command,
      beam_command: multiply(beam, encoder_command),
      tachometer_wind: multiply(multiply(rate, g), blow),
      torque_wind: times(-1, multiply(multiply(multiply(g, oil), s), blow)),
      encoder_wind,
      beam_wind: add(multiply(beam, encoder_wind), bending),
    };
  };

  // -- Wind ----------------------------------------------------------------------------------------

  // Gauss's rule on [-1, 1] by Newton's method on Legendre's polynomial.
  const gaussRule = (count) => Array.from({ length: count }, (_, i) => {
    let x = Math.cos(Math.PI * (i + 0.75) / (count + 0.5)), slope = 1;
    for (let step = 0; step < 8; ++step) {
      let before = 1, value = x;
      for (let k = 2; k <= count; ++k) [before, value] = [value, ((2 * k - 1) * x * value - (k - 1) * before) / k];
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    return { node: x, weight: 2 / ((1 - x * x) * slope * slope) };
  });

  const lensMeanSquare = (t) => {
    const angle = Math.acos(t), height = Math.sqrt((1 - t) * (1 + t));
    const about = 0.5 * (angle - t * t * t * height - t * height ** 3 / 3);
    return (about - 4 / 3 * t * height ** 3) / (angle - t * height) + t * t;
  };
  // What the averages over pairs of points of the disc need at each node, for an end of 1.
  const disc = gaussRule(48).map(({ node, weight }) => ({ phase: Math.PI / 4 * (node + 1), weight: weight * Math.PI / 4 }));
  const discPoint = (phase, weight, end) => {
    const sine = Math.sin(phase), t = end * sine * sine;
    const density = 16 * t / Math.PI * (Math.acos(t) - t * Math.sqrt((1 - t) * (1 + t)));
    const step = end * 2 * sine * Math.cos(phase) * weight * density;
    return { t, step, lever: 0.5 * (lensMeanSquare(t) - t * t) };
  };
  const whole = disc.map(({ phase, weight }) => discPoint(phase, weight, 1));

  const coherenceAverages = (decay) => {
    const exponent = 2 * decay, end = exponent > 45 ? 45 / exponent : 1;
    const points = end === 1 ? whole : disc.map(({ phase, weight }) => discPoint(phase, weight, end));
    let uniform = 0, gradient = 0;
    for (const { t, step, lever } of points) {
      const part = Math.exp(-exponent * t) * step;
      uniform += part;
      gradient += part * lever;
    }
    return { uniform, gradient };
  };

  const gustSpectrum = (gusts, speed, frequency) => {
    if (gusts.kind === "davenport") {
      const x = 1200 * frequency / speed;
      return 4 * gusts.surface_drag_1 * speed * speed * x * x / (frequency * (1 + x * x) ** (4 / 3));
    }
    const time = gusts.length_scale_m / speed, x = frequency * time;
    const at_zero = (gusts.turbulence_intensity_1 * speed) ** 2 * time;
    // (2 sqrt(pi) Gamma(1/3)/Gamma(5/6))^2
    if (gusts.kind === "von_karman") return 4 * at_zero / (1 + 70.78012763381727 * x * x) ** (5 / 6);
    if (gusts.kind === "kaimal") return 4 * at_zero / (1 + 6 * x) ** (5 / 3);
    return 6.8 * at_zero / (1 + 10.2 * x) ** (5 / 3);
  };

  // One-sided spectrum of the wind torque at the motor shaft, (N m)^2/Hz.
  const windSpectrum = (data, speed, frequency) => {
    const { wind } = data;
    const gust = gustSpectrum(wind.gusts, speed, frequency) / data.gear_ratio_1 ** 2;
    const area = Math.PI / 4 * wind.dish_diameter_m ** 2;
    const per_gust = wind.air_density_kg_per_m3 * speed * area * wind.dish_diameter_m * wind.torque_coefficient_1;
    if (wind.model === "uniform") return per_gust ** 2 * gust;
    if (wind.model === "vickery") {
      const admittance = 1 / (1 + (2 * frequency * Math.sqrt(area) / speed) ** (4 / 3));
      return per_gust ** 2 * gust * admittance * admittance;
    }
    const radius = 0.5 * wind.dish_diameter_m;
    const { uniform, gradient } = coherenceAverages(wind.coherence_decay_1 * frequency * radius / speed);
    const lever = wind.air_density_kg_per_m3 * speed * wind.gradient_coefficient_1 * area * radius;
    return gust * (per_gust ** 2 * uniform + lever ** 2 * gradient);
  };

  // -- Controller ----------------------------------------------------------------------------------

  // Each block with its own gains.
  const placed = (data, gains) => {
    let next = 0;
    const all = data.blocks.map(({ path, kind, gains: of_block }) => ({ path, kind, g: gains.slice(next, (next += of_block.length)) }));
    // The linear loop is that of an integral without dead zone or freeze.
    return all.filter(({ kind }) => kind !== "dead_zone" && kind !== "freeze");
  };

  const blockAt = (kind, g, w) => {
    switch (kind) {
      case "gain": return complex(g[0], 0);
      case "integral": return complex(1, -g[0] / w);
      case "lag": return inverse(complex(1, w / g[0]));
      case "lead": return complex(1, w / g[0]);
      case "washout": return inverse(complex(1, -g[0] / w));
      default: {
        const real = g[0] * g[0] - w * w;
        return multiply(complex(real, 2 * g[1] * g[0] * w), inverse(complex(real, 2 * g[2] * g[0] * w)));
      }
    }
  };

  const controllerAt = (blocks, w) => {
    const paths = { rate: null, pressure: null, position: null, compliance: null };
    for (const { path, kind, g } of blocks) {
      const factor = blockAt(kind, g, w);
      paths[path] = paths[path] === null ? factor : multiply(paths[path], factor);
    }
    return paths;
  };

  // Returns 1 + L with the position loop open and closed, and what the variances need; exact dead time.
  const loopAt = (blocks, response, dead_time, w) => {
    const { rate: r, pressure: q, position: p, compliance: c } = controllerAt(blocks, w);
    const late = complex(Math.cos(w * dead_time), -Math.sin(w * dead_time));
    let rate = multiply(r, response.tachometer_command);
    if (q !== null) rate = add(rate, multiply(q, response.torque_command));
    let angle = response.encoder_command;
    if (c !== null) angle = subtract(angle, multiply(c, response.torque_command));
    const rp = multiply(r, p);
    rate = multiply(late, rate);
    const position = multiply(late, multiply(rp, angle));
    return { r, q, p, c, rp, late, rate, position };
  };

  // L cut at the valve command with the position loop open, at the valve command, at the rate command.
  const breaks = ["rate loop alone", "valve command", "position loop"];
  const loopGains = ({ rate, position }) => [rate, add(rate, position), multiply(position, inverse(add(one, rate)))];

  // -- State space ---------------------------------------------------------------------------------

  // A chain of rows over the states and two inputs: position command and rate command.
  const delay_order = 8;
  const assemble = (data, setting, gains, position_closed) => {
    const plant = numbersOf(data, setting), blocks = placed(data, gains);
    const own = { gain: 0, integral: 1, lag: 1, lead: 0, washout: 1, notch: 2 };
    const paths = position_closed ? ["compliance", "position", "rate", "pressure"] : ["rate", "pressure"];
    const used = blocks.filter(({ path }) => paths.includes(path));
    const delayed = data.dead_time_s > 0 ? delay_order : 0;
    const angles = position_closed ? 1 : 0;
    const size = 7 + 2 * plant.modes.length + angles + delayed + used.reduce((sum, { kind }) => sum + own[kind], 0);
    const rows = Matrices.zeros(size, size + 2);
    const sum = (...terms) => {
      const row = new Float64Array(size + 2);
      for (const [factor, other] of terms) for (let j = 0; j < row.length; ++j) row[j] += factor * other[j];
      return row;
    };
    const unit = (j) => {
      const row = new Float64Array(size + 2);
      row[j] = 1;
      return row;
    };
    let next = 0;
    const state = () => unit(next++);
    const set = (row, ...terms) => { rows[row.indexOf(1)] = sum(...terms); };

    // Angles of motor and modes are taken from the bull gear's, which alone is free.
    const valve = state(), valve_rate = state(), torque = state(), motor_rate = state(), twist = state();
    const bull_rate = state(), tachometer = state();
    const modes = plant.modes.map((mode) => ({ ...mode, bend: state(), rate: state() }));
    const bull = position_closed ? state() : null;
    const gear = [[plant.kg, twist], [plant.cg, motor_rate], [-plant.cg, bull_rate]];
    const over = (inertia, terms, sign) => terms.map(([factor, row]) => [sign * factor / inertia, row]);
    const spring = ({ k, c, bend, rate }) => [[k, bend], [c, rate], [-c, bull_rate]];
    set(valve, [plant.wv, valve_rate]);
    set(torque, [plant.K, valve], [-plant.K, motor_rate], [-plant.lambda, torque]);
    set(motor_rate, ...over(plant.Jm, [[1, torque], [-plant.Bf, motor_rate]], 1), ...over(plant.Jm, gear, -1));
    set(twist, [1, motor_rate], [-1, bull_rate]);
    set(bull_rate, ...over(plant.Jb, [...gear, ...modes.flatMap(spring)], 1));
    set(tachometer, [plant.wt, motor_rate], [-plant.wt, tachometer]);
    for (const mode of modes) {
      set(mode.bend, [1, mode.rate], [-1, bull_rate]);
      set(mode.rate, ...over(mode.J, spring(mode), -1));
    }
    if (position_closed) set(bull, [1, bull_rate]);

    const section = ({ kind, g }, input) => {
      if (kind === "gain") return sum([g[0], input]);
      const x = state();
      if (kind === "integral") {
        set(x, [1, input]);
        return sum([1, input], [g[0], x]);
      }
      if (kind === "notch") {
        const y = state();
        set(x, [g[0], y]);
        set(y, [-g[0], x], [-2 * g[2] * g[0], y], [g[0], input]);
        return sum([1, input], [2 * (g[1] - g[2]), y]);
      }
      set(x, [g[0], input], [-g[0], x]);
      return kind === "lag" ? x : sum([1, input], [-1, x]);
    };
    // Each lead with a lag of its path: (1 + s/wz)/(1 + s/wp).
    const chain = (path, input) => {
      const leads = used.filter((block) => block.path === path && block.kind === "lead").map(({ g }) => g[0]);
      let signal = input;
      for (const block of used.filter((one_block) => one_block.path === path && one_block.kind !== "lead")) {
        const before = signal;
        signal = section(block, before);
        if (block.kind !== "lag" || leads.length === 0) continue;
        const ratio = block.g[0] / leads.shift();
        signal = sum([1 - ratio, signal], [ratio, before]);
      }
      return signal;
    };
    const has = (path) => used.some((block) => block.path === path);
    const position_command = unit(size), rate_command = unit(size + 1);
    let wanted = rate_command;
    if (position_closed) {
      const angle = has("compliance") ? sum([1, bull], [-1, chain("compliance", torque)]) : bull;
      wanted = sum([1, wanted], [-1, chain("position", sum([1, angle], [-1, position_command]))]);
    }
    let demand = chain("rate", sum([1, wanted], [-1, tachometer]));
    if (has("pressure")) demand = sum([1, demand], [-1, chain("pressure", torque)]);

    // The [7/8] Pade approximant of the dead time in shifted Legendre polynomials.
    let command = demand;
    if (delayed > 0) {
      const states = Array.from({ length: delay_order }, state);
      const root = states.map((_, i) => Math.sqrt(2 * i + 1));
      const sign = (power) => (power % 2 === 0 ? 1 : -1);
      states.forEach((row, i) => set(row, [sign(i) * root[i] / data.dead_time_s, demand],
        ...states.map((other, j) => [root[i] * root[j] / data.dead_time_s * (i < j ? -1 : sign(i - j + 1)), other])));
      command = sum(...states.map((row, i) => [root[i], row]));
    }
    set(valve_rate, [-plant.wv, valve], [-2 * plant.zv * plant.wv, valve_rate], [plant.wv, command]);
    return { rows, size, encoder: bull, tachometer };
  };

  return {
    one, complex, add, subtract, multiply, times, square, magnitude, inverse,
    numbersOf, responseAt, windSpectrum, placed, loopAt, loopGains, breaks, delay_order, assemble,
  };
})();
