"use strict";
// Boresight rms, stability, margins and step responses of a LoopModel, as the program has them
// (design/problem, control/loops/closed_loop, control/analysis/margins).
const LoopAnalysis = (() => {
  const {
    one, complex, add, subtract, multiply, square, magnitude, inverse,
    numbersOf, responseAt, windSpectrum, placed, loopAt, loopGains, breaks, delay_order, assemble,
  } = LoopModel;
  const two_pi = 2 * Math.PI;

  const matrixOf = ({ rows, size }) => rows.map((row) => row.slice(0, size));
  const abscissa = (matrix) => Math.max(...Matrices.eigenvalues(matrix).map(({ re }) => re));

  // -- Frequencies ---------------------------------------------------------------------------------

  const plantPoles = (data, setting) => {
    // Without a controller; the free angle has no pole that a grid follows.
    const silent = { ...data, blocks: [{ path: "rate", kind: "gain", gains: [{}] }], dead_time_s: 0 };
    return Matrices.eigenvalues(matrixOf(assemble(silent, setting, [0], false)));
  };

  // The grid of design::analysis_grid: rad/s.
  const analysisGrid = (data, setting) => {
    const lowest = Math.min(data.lowest_frequency_Hz, 1e-4);
    const highest = Math.max(data.highest_frequency_Hz, 25, 8 * data.drive.valve_corner_rad_per_s / two_pi);
    const decades = Math.log10(highest / lowest), intervals = Math.ceil(decades * data.points_per_decade);
    const points = Array.from({ length: intervals + 1 }, (_, i) => two_pi * lowest * 10 ** (decades * i / intervals));
    const first = points[0];
    for (const { re, im } of plantPoles(data, setting)) {
      if (im <= 0 || -re > 0.1 * Math.hypot(re, im)) continue;
      for (let k = -12; k <= 12; ++k) {
        const w = im - 4 * re * k / 12;
        if (w > first && w < two_pi * highest) points.push(w);
      }
    }
    points.sort((x, y) => x - y);
    const grid = [];
    for (const w of points) if (grid.length === 0 || w - grid[grid.length - 1] >= 1e-9 * w) grid.push(w);
    for (const edge of [data.lowest_frequency_Hz, data.highest_frequency_Hz, data.noise.bandwidth_Hz]) {
      const w = two_pi * edge, next = grid.findIndex((point) => point >= w * (1 - 1e-9));
      if (next > 0 && grid[next] >= w * (1 + 1e-9)) grid.splice(next, 0, w);
    }
    return grid;
  };

  // Trapezoid weights in ln f, per Hz, of the intervals within the band.
  const weights = (grid, lowest, highest) => {
    const weight = new Float64Array(grid.length);
    for (let i = 0; i + 1 < grid.length; ++i) {
      if (grid[i] < two_pi * lowest * (1 - 1e-9) || grid[i + 1] > two_pi * highest * (1 + 1e-9)) continue;
      const half = 0.5 * Math.log(grid[i + 1] / grid[i]);
      weight[i] += half * grid[i] / two_pi;
      weight[i + 1] += half * grid[i + 1] / two_pi;
    }
    return weight;
  };

  // What does not depend on gains.
  const prepare = (data, setting) => {
    const plant = numbersOf(data, setting), grid = analysisGrid(data, setting);
    const { lowest_frequency_Hz: lowest, highest_frequency_Hz: highest, noise } = data;
    const band = weights(grid, lowest, highest);
    return {
      data, setting, plant, grid,
      responses: grid.map((w) => responseAt(plant, w)),
      wind: grid.map((w, i) => (band[i] > 0 ? band[i] * windSpectrum(data, setting.wind_speed, w / two_pi) : 0)),
      noise: weights(grid, lowest, Math.min(highest, noise.bandwidth_Hz)),
    };
  };

  // -- Results -------------------------------------------------------------------------------------

  // rad at the sky; effort: rad/s of valve command from the sensors' noise.
  const rms = (prepared, gains) => {
    const { data, grid, responses } = prepared, blocks = placed(data, gains);
    const density = (value) => value * value / data.noise.bandwidth_Hz;
    const tachometer = density(data.noise.tachometer_rad_per_s), encoder = density(data.noise.encoder_rad), torque = density(data.noise.torque_N_m);
    let wind = 0, noise = 0, effort = 0;
    grid.forEach((w, i) => {
      if (prepared.wind[i] === 0 && prepared.noise[i] === 0) return;
      const response = responses[i];
      const { r, q, c, rp, late, rate, position } = loopAt(blocks, response, data.dead_time_s, w);
      const closed = inverse(add(one, add(rate, position)));
      let angle = response.encoder_wind;
      if (c !== null) angle = subtract(angle, multiply(c, response.torque_wind));
      let measured = add(multiply(r, response.tachometer_wind), multiply(rp, angle));
      if (q !== null) measured = add(measured, multiply(q, response.torque_wind));
      const act = multiply(multiply(late, response.beam_command), closed);
      wind += prepared.wind[i] * square(subtract(response.beam_wind, multiply(act, measured)));
      const torque_path = subtract(q ?? complex(0, 0), c === null ? complex(0, 0) : multiply(rp, c));
      const demand = prepared.noise[i] * square(closed) * (tachometer * square(r) + encoder * square(rp) + torque * square(torque_path));
      effort += demand;
      noise += demand * square(response.beam_command);
    });
    const at_sky = (variance) => Math.sqrt(variance) / data.gear_ratio_1;
    return { beam: at_sky(wind + noise), wind: at_sky(wind), noise: at_sky(noise), effort: Math.sqrt(effort) };
  };

  // What the rational dead time leaves out, as control::StabilityVerdict has it.
  const deadTimeResidue = (prepared, gains) => {
    const { data, grid, responses } = prepared, blocks = placed(data, gains), late = data.dead_time_s;
    let residue = 0;
    // Coefficients of the [7/8] approximant in s times the dead time.
    const coefficients = (order, sign) => {
      const list = [1];
      for (let k = 0; k < order; ++k) list.push(list[k] * sign * (order - k) / ((2 * delay_order - 1 - k) * (k + 1)));
      return list;
    };
    const above = coefficients(delay_order - 1, -1), below = coefficients(delay_order, 1);
    const polynomial = (list, x) => list.reduceRight((value, coefficient) => add(multiply(value, complex(0, x)), complex(coefficient, 0)), complex(0, 0));
    grid.forEach((w, i) => {
      if (w * late < 0.1) return;
      const exact = complex(Math.cos(w * late), Math.sin(w * late));
      const rational = multiply(polynomial(above, w * late), inverse(polynomial(below, w * late)));
      const change = subtract(one, multiply(rational, exact));
      for (const gain of loopGains(loopAt(blocks, responses[i], late, w)).slice(0, 2)) {
        residue = Math.max(residue, magnitude(multiply(multiply(change, gain), inverse(add(one, gain)))));
      }
    });
    return residue;
  };

  const stability = (prepared, gains) => {
    const { data, setting } = prepared;
    const rate_loop_abscissa = abscissa(matrixOf(assemble(data, setting, gains, false)));
    const closed_loop_abscissa = abscissa(matrixOf(assemble(data, setting, gains, true)));
    const dead_time_residue = deadTimeResidue(prepared, gains);
    return { rate_loop_abscissa, closed_loop_abscissa, dead_time_residue, stable: rate_loop_abscissa < 0 && closed_loop_abscissa < 0 && dead_time_residue < 1 };
  };

  const bisect = (f, low, high, at_low) => {
    for (let step = 0; step < 80; ++step) {
      const middle = 0.5 * (low + high);
      if (middle === low || middle === high) break;
      if (f(middle) > 0 === at_low > 0) low = middle;
      else high = middle;
    }
    return 0.5 * (low + high);
  };

  const goldenMaximum = (f, low, high) => {
    const ratio = 0.5 * (Math.sqrt(5) - 1);
    let x = high - ratio * (high - low), y = low + ratio * (high - low), fx = f(x), fy = f(y);
    for (let step = 0; step < 60 && high - low > 1e-9; ++step) {
      if (fx > fy) {
        [high, y, fy] = [y, x, fx];
        x = high - ratio * (high - low);
        fx = f(x);
      } else {
        [low, x, fx] = [x, y, fy];
        y = low + ratio * (high - low);
        fy = f(y);
      }
    }
    return 0.5 * (low + high);
  };

  // Where f changes sign along x, with pairs of changes between two points of the grid.
  const crossings = (x, values, f) => {
    const roots = [];
    for (let i = 1; i < x.length; ++i) {
      if (values[i - 1] > 0 !== values[i] > 0) {
        roots.push(bisect(f, x[i - 1], x[i], values[i - 1]));
        continue;
      }
      const next = values[i + 1];
      if (next === undefined || next > 0 !== values[i] > 0) continue;
      const here = Math.abs(values[i]), side = values[i] > 0 ? 1 : -1;
      if (here > 0.2 || here > Math.abs(values[i - 1]) || here > Math.abs(next)) continue;
      const turn = goldenMaximum((place) => -side * f(place), x[i - 1], x[i + 1]);
      if (side * f(turn) >= 0) continue;
      roots.push(bisect(f, x[i - 1], turn, side), bisect(f, turn, x[i + 1], -side));
    }
    return roots;
  };

  // Gain (factors), phase (degrees) and delay margins, the highest gain crossover and the peak of |S|
  // at each break.
  const margins = (prepared, gains) => {
    const { data, plant, grid, responses } = prepared, blocks = placed(data, gains);
    const x = grid.map(Math.log);
    const onGrid = grid.map((w, i) => loopGains(loopAt(blocks, responses[i], data.dead_time_s, w)));
    return breaks.map((name, b) => {
      const values = onGrid.map((gain) => gain[b]);
      const at = (place) => {
        const w = Math.exp(place);
        return loopGains(loopAt(blocks, responseAt(plant, w), data.dead_time_s, w))[b];
      };
      const level = (gain) => 0.5 * Math.log(square(gain)), turn = (gain) => gain.im / magnitude(gain);
      const result = { name, gain_up: Infinity, gain_down: 0, phase_deg: 180, delay: Infinity, crossover: 0, peak: 0, peak_frequency: 0 };
      for (const root of crossings(x, values.map(level), (place) => level(at(place)))) {
        const gain = at(root), phase = Math.atan2(-gain.im, -gain.re);
        result.phase_deg = Math.min(result.phase_deg, Math.abs(phase) * 180 / Math.PI);
        result.crossover = Math.max(result.crossover, Math.exp(root));
        result.delay = Math.min(result.delay, (phase >= 0 ? phase : phase + two_pi) / Math.exp(root));
      }
      for (const root of crossings(x, values.map(turn), (place) => turn(at(place)))) {
        const gain = at(root);
        if (gain.re >= 0 || Math.abs(turn(gain)) > 0.01) continue;
        const factor = 1 / magnitude(gain);
        if (factor > 1) result.gain_up = Math.min(result.gain_up, factor);
        else result.gain_down = Math.max(result.gain_down, factor);
      }
      const sensitivity = (gain) => 1 / magnitude(add(one, gain));
      const heights = values.map(sensitivity), highest = Math.max(...heights);
      const keep = (place, height) => {
        if (height > result.peak) Object.assign(result, { peak: height, peak_frequency: Math.exp(place) });
      };
      heights.forEach((height, i) => {
        keep(x[i], height);
        if (i === 0 || i + 1 === heights.length || height < 0.8 * highest || height < heights[i - 1] || height <= heights[i + 1]) return;
        const top = goldenMaximum((place) => sensitivity(at(place)), x[i - 1], x[i + 1]);
        keep(top, sensitivity(at(top)));
      });
      return result;
    });
  };

  // Responses to a unit step at t = 0, from rest, at `count` times `step` apart: of the encoder to
  // the position command, and of the tachometer to the rate command with the position loop open.
  const stepResponse = (data, setting, gains, position_closed, step, count) => {
    const { rows, size, encoder, tachometer } = assemble(data, setting, gains, position_closed);
    const input = position_closed ? size : size + 1, output = position_closed ? encoder : tachometer;
    const held = Matrices.zeros(size + 1, size + 1);
    rows.forEach((row, i) => {
      for (let j = 0; j < size; ++j) held[i][j] = step * row[j];
      held[i][size] = step * row[input];
    });
    const forward = Matrices.exponential(held);
    let x = new Float64Array(size + 1);
    x[size] = 1;
    const read = output.indexOf(1), values = [];
    for (let k = 0; k < count; ++k) {
      values.push(x[read]);
      x = forward.map((row) => row.reduce((sum, factor, j) => sum + factor * x[j], 0));
    }
    return values;
  };

  return { breaks, prepare, rms, stability, margins, stepResponse };
})();
