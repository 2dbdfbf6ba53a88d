"use strict";
// Sliders over a controller's gains, its wind and its drive: boresight rms, margins and step
// responses by LoopAnalysis, and the gains as text for --gains.
(() => {
  const panel = document.querySelector(".loop-sliders");
  if (!panel) return;
  const data = JSON.parse(panel.querySelector("script.data").textContent);
  panel.hidden = false;
  const note = document.querySelector(".loop-sliders-needs-script");
  if (note) note.hidden = true;

  const known = data.blocks.flatMap(({ gains }) => gains);
  const start = {
    gains: known.map(({ value }) => value),
    setting: {
      wind_speed: data.wind.mean_speed_m_per_s, oil_stiffness: data.drive.oil_stiffness_N_m_per_rad,
      leakage_rate: data.drive.leakage_rate_per_s, viscous_friction: data.drive.viscous_friction_N_m_s_per_rad,
    },
  };
  const sliders = [...panel.querySelectorAll("input[type=range]")];
  const at = (slider, value) => value * Number(slider.dataset.span) ** Number(slider.value);
  // A slider that was moved gives four digits, which the text for --gains repeats.
  const moved = (slider, value) => (Number(slider.value) === 0 ? value : Number(at(slider, value).toPrecision(4)));
  const chosen = () => {
    const gains = [...start.gains], setting = { ...start.setting };
    for (const slider of sliders) {
      const { gain, setting: key } = slider.dataset;
      if (gain !== undefined) gains[Number(gain)] = moved(slider, start.gains[Number(gain)]);
      else setting[key] = moved(slider, start.setting[key]);
    }
    return { gains, setting };
  };

  const in_millidegrees = (rad) => rad * 180e3 / Math.PI;
  const decibels = (factor) => 20 * Math.log10(factor);
  const millidegrees = (rad) => in_millidegrees(rad).toFixed(4);

  let prepared = null, prepared_for = "";
  const prepare = (setting) => {
    const key = JSON.stringify(setting);
    if (key !== prepared_for) prepared = LoopAnalysis.prepare(data, setting);
    prepared_for = key;
    return prepared;
  };
  const analyse = ({ gains, setting }) => {
    const model = prepare(setting);
    const stability = LoopAnalysis.stability(model, gains);
    if (!stability.stable) return { stability };
    return { stability, rms: LoopAnalysis.rms(model, gains), margins: LoopAnalysis.margins(model, gains) };
  };

  const first = analyse(start);
  const samples = 200;
  const step = 20 / first.margins[2].crossover / (samples - 1);
  const responses = ({ gains, setting }) => [true, false].map((closed) => LoopAnalysis.stepResponse(data, setting, gains, closed, step, samples));
  const first_responses = responses(start);

  // The constraints a result breaks, in words.
  const broken = ({ rms, margins }) => {
    const found = [];
    data.limits.loop_breaks.forEach((limit, b) => {
      const loop = margins[b], where = `of the loop cut at: ${loop.name}`;
      if (loop.peak > limit.sensitivity_peak_1 * (1 + 1e-6)) found.push(`Ms ${loop.peak.toFixed(3)} above ${limit.sensitivity_peak_1}, ${where}`);
      const gain = decibels(Math.min(loop.gain_up, 1 / loop.gain_down));
      if (limit.gain_margin_dB !== null && gain < limit.gain_margin_dB - 1e-5) found.push(`gain margin ${gain.toFixed(2)} dB below ${limit.gain_margin_dB.toFixed(2)}, ${where}`);
      if (limit.phase_margin_deg !== null && loop.phase_deg < limit.phase_margin_deg - 1e-4) found.push(`phase margin ${loop.phase_deg.toFixed(1)} deg below ${limit.phase_margin_deg.toFixed(1)}, ${where}`);
    });
    const effort = data.limits.control_effort_rad_per_s;
    if (rms.effort > effort * (1 + 1e-5)) found.push(`control effort ${rms.effort.toFixed(3)} rad/s above ${effort}`);
    return found;
  };

  const element = (tag, text, attributes = {}) => {
    const made = document.createElement(tag);
    made.textContent = text;
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    return made;
  };
  const drawn = (tag, attributes, text) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    if (text !== undefined) made.textContent = text;
    return made;
  };

  const answer = panel.querySelector(".answer"), verdicts = panel.querySelector(".verdicts"), rows = panel.querySelector(".margins tbody");
  const say = ({ stability, rms, margins }) => {
    answer.dataset.rms = rms ? in_millidegrees(rms.beam) : "";
    answer.textContent = rms ? `${millidegrees(rms.beam)} mdeg ` : "unstable ";
    answer.append(element("small", rms ? `boresight rms per axis; wind ${millidegrees(rms.wind)}, sensors ${millidegrees(rms.noise)}; at the start ${millidegrees(first.rms.beam)}`
      : stability.rate_loop_abscissa >= 0 ? "the rate loop alone" : stability.closed_loop_abscissa >= 0 ? "with both loops closed" : "not shown stable with the exact dead time"));
    const missed = rms ? broken({ rms, margins }) : [];
    const lines = !rms ? [] : missed.length > 0 ? missed.map((line) => `\u2717 ${line}`) : ["\u2713 meets the constraints on Ms, margins and control effort, on this plant"];
    if (rms) lines.push(`control effort ${rms.effort.toFixed(3)} rad/s`);
    verdicts.replaceChildren(...lines.map((line) => element("li", line)));
    rows.replaceChildren(...(margins ?? []).map((loop) => {
      const row = element("tr", "");
      row.append(element("th", loop.name, { scope: "row" }));
      for (const [value, digits] of [[decibels(loop.gain_up), 1], [decibels(loop.gain_down), 1], [loop.phase_deg, 1], [loop.peak, 3]]) {
        row.append(element("td", Number.isFinite(value) ? value.toFixed(digits) : "none", { class: "right" }));
      }
      return row;
    }));
  };

  const drawing = panel.querySelector(".steps");
  const draw = (curves) => {
    const box = { left: 48, right: 500, top: 8, bottom: 195 };
    // Letters of 12 px or more on a phone too.
    drawing.setAttribute("font-size", Math.min(12 * Math.max(1, 520 / (drawing.clientWidth || 520)), 20));
    const seen = [...first_responses, ...curves].flat();
    // What an unstable loop does leaves the drawing.
    const top = Math.min(Math.max(1.2, ...seen), 3), bottom = Math.max(Math.min(0, ...seen), -1);
    const x = (k) => box.left + (k / (samples - 1)) * (box.right - box.left);
    const y = (value) => box.bottom - ((Math.min(Math.max(value, bottom), top) - bottom) / (top - bottom)) * (box.bottom - box.top);
    const line = (values, attributes) => drawn("path", { d: values.map((value, k) => `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(value).toFixed(1)}`).join(""), fill: "none", ...attributes });
    drawing.replaceChildren();
    for (let value = Math.ceil(bottom * 2) / 2; value <= top; value += 0.5) {
      drawing.append(drawn("path", { d: `M${box.left} ${y(value)}H${box.right}`, stroke: "#e2e2e2" }), drawn("text", { x: box.left - 6, y: y(value) + 4, "text-anchor": "end" }, value));
    }
    const duration = step * (samples - 1), decade = 10 ** Math.floor(Math.log10(duration / 4));
    const tick = [5, 2, 1].map((factor) => factor * decade).find((width) => 4 * width <= duration);
    for (let k = 0; k * tick <= duration; ++k) {
      drawing.append(drawn("text", { x: x(k * tick / step), y: box.bottom + 19, "text-anchor": "middle" }, Number((k * tick).toPrecision(6))));
    }
    first_responses.forEach((values, k) => drawing.append(line(values, { stroke: "#9aa3ad", "stroke-width": 1.2, "stroke-dasharray": k ? "6 4" : "none" })));
    curves.forEach((values, k) => drawing.append(line(values, { class: k ? "rate" : "position", stroke: k ? "#b4530a" : "#174a74", "stroke-width": 2.2, "stroke-dasharray": k ? "6 4" : "none" })));
    drawing.append(drawn("path", { d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`, fill: "none", stroke: "#333" }),
      drawn("text", { x: (box.left + box.right) / 2, y: box.bottom + 40, "text-anchor": "middle", "font-weight": 600 }, "time (s)"));
  };

  // Shells take what stands in quotes as it is.
  const word = (text) => (/^[\w.=+-]+$/.test(text) ? text : `'${text}'`);
  const command = ({ gains }) => ["--structure", word(data.structure), "--gains",
    ...known.map(({ symbol, unit }, i) => word(`${symbol}=${gains[i]}${unit === "1" ? "" : ` ${unit}`}`))].join(" ");

  const output = panel.querySelector(".gains-text");
  const show = () => {
    const now = chosen();
    for (const slider of sliders) {
      const { gain, setting: key } = slider.dataset;
      const value = gain !== undefined ? now.gains[Number(gain)] : now.setting[key];
      const said = `${Number(value.toPrecision(4))} ${slider.dataset.unit}`.trim();
      slider.closest("label").querySelector("output").textContent = said;
      slider.setAttribute("aria-valuetext", said);
    }
    say(analyse(now));
    draw(responses(now));
    output.textContent = command(now);
  };

  let waiting = false;
  const show_soon = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      show();
    });
  };
  for (const slider of sliders) slider.addEventListener("input", show_soon);
  addEventListener("resize", show_soon);
  panel.querySelector(".reset").addEventListener("click", () => {
    for (const slider of sliders) slider.value = 0;
    show();
  });
  // Marks the text besides, for pages that may not write to the clipboard.
  panel.querySelector(".copy").addEventListener("click", () => {
    getSelection().selectAllChildren(output);
    navigator.clipboard?.writeText(output.textContent).catch(() => {});
  });
  show();
})();
