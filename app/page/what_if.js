"use strict";
// Sliders over the matching study's table: what the controllers give, gains fixed, where the antenna or the wind is
// not what they were tuned for.
(() => {
  const panel = document.querySelector(".what-if");
  if (!panel) return;
  const table = JSON.parse(panel.querySelector("script.data").textContent);
  panel.hidden = false;
  const note = document.querySelector(".what-if-needs-script");
  if (note) note.hidden = true;

  const sizes = [table.flywheel_disks_1, table.leakage_rates_per_s, table.friction_slopes_N_m_s_per_rad, table.wind_speeds_m_per_s];
  const units = [["disk", "disks"], ["1/s"], ["N m s/rad"], ["m/s"]];
  const names = ["disks", "leakage", "friction", "wind"];
  const place = (structure, at) => at.reduce((sum, index, axis) => sum * sizes[axis].length + index, structure);
  const number = (value, digits) => (value === null ? "none" : value.toFixed(digits));

  // Where a slider stands: an axis value, and the table's points about it with their weights. The
  // logarithm of the rms is taken as linear in each of them, over the wind in the speed's logarithm.
  const between = (axis, position) => {
    const values = sizes[axis];
    const low = Math.min(Math.floor(position), values.length - 1);
    const high = Math.min(low + 1, values.length - 1);
    const part = position - low;
    const value = values[low] + part * (values[high] - values[low]);
    if (part === 0 || low === high) return { value, ends: [[low, 1]] };
    const fraction = axis === 3 ? Math.log(value / values[low]) / Math.log(values[high] / values[low]) : part;
    return { value, ends: [[low, 1 - fraction], [high, fraction]] };
  };

  const look = (structure, positions) => {
    const axes = positions.map((position, axis) => between(axis, position));
    let corners = [{ at: [], weight: 1 }];
    for (const { ends } of axes) {
      corners = corners.flatMap(({ at, weight }) => ends.map(([index, fraction]) => ({ at: [...at, index], weight: weight * fraction })));
    }
    const answer = { values: axes.map(({ value }) => value), state: 2, rms: 0, between: corners.length > 1 };
    for (const { at, weight } of corners) {
      const entry = place(structure, at);
      const rms = table.boresight_rms_mdeg[entry];
      answer.state = Math.min(answer.state, rms === null ? 0 : table.states_1[entry]);
      if (rms !== null) answer.rms += weight * Math.log(rms);
    }
    // A single entry is shown as the table has it.
    answer.rms = answer.state === 0 ? null : answer.between ? Math.exp(answer.rms) : table.boresight_rms_mdeg[place(structure, corners[0].at)];
    return answer;
  };

  const select = panel.querySelector("select");
  const sliders = names.map((name) => panel.querySelector(`input[name=${name}]`));
  const positions = () => sliders.map((slider) => Number(slider.value));

  const text = (tag, attributes, content) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    if (content !== undefined) element.textContent = content;
    return element;
  };

  const drawing = panel.querySelector(".curve");
  const draw = (chosen, where) => {
    // A unit is a pixel, whatever the panel's width: letters stay as large as they are.
    const width = Math.max(drawing.clientWidth, 280);
    drawing.setAttribute("viewBox", `0 0 ${width} 275`);
    const box = { left: 52, right: width - 20, top: 20, bottom: 232 };
    const disks = sizes[0];
    const curves = table.structures.map((name, s) => disks.map((_, d) => look(s, [d, ...where.slice(1)]).rms));
    const budget = table.budgets.map(({ rms_mdeg }) => rms_mdeg);
    const seen = curves.flat().filter((value) => value !== null);
    const largest = Math.max(...seen, 0);
    const top = 1.08 * Math.max(largest, ...budget.filter((rms) => rms < 1.6 * largest));
    const x = (value) => box.left + ((value - disks[0]) / (disks[disks.length - 1] - disks[0])) * (box.right - box.left);
    const y = (value) => box.bottom - (value / top) * (box.bottom - box.top);
    const path = (values) => {
      let pen = "M";
      return values.map((value, d) => {
        if (value === null) {
          pen = "M";
          return "";
        }
        const step = `${pen}${x(disks[d]).toFixed(1)} ${y(value).toFixed(1)}`;
        pen = "L";
        return step;
      }).join("");
    };
    drawing.replaceChildren();
    const step = 10 ** Math.floor(Math.log10(top)) * (top / 10 ** Math.floor(Math.log10(top)) > 4 ? 1 : top / 10 ** Math.floor(Math.log10(top)) > 2 ? 0.5 : 0.2);
    for (let value = 0; value <= top; value += step) {
      drawing.append(text("path", { d: `M${box.left} ${y(value)}H${box.right}`, stroke: "#e2e2e2" }), text("text", { x: box.left - 7, y: y(value) + 4, "text-anchor": "end" }, Number(value.toPrecision(6))));
    }
    for (let value = disks[0]; value <= disks[disks.length - 1]; value += Math.ceil((disks[disks.length - 1] - disks[0]) / 6)) {
      drawing.append(text("text", { x: x(value), y: box.bottom + 17, "text-anchor": "middle" }, value));
    }
    curves.forEach((values, s) => {
      if (s !== chosen) drawing.append(text("path", { d: path(values), fill: "none", stroke: "#b5bcc4", "stroke-width": 1 }));
    });
    drawing.append(text("path", { class: "chosen", d: path(curves[chosen]), fill: "none", stroke: "#174a74", "stroke-width": 2.4 }));
    drawing.append(text("path", { d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`, fill: "none", stroke: "#333" }));
    // Names of budgets stand above their lines, or below where those of another are; else nowhere.
    const feet = [];
    for (const { rms_mdeg, band } of table.budgets.toSorted((a, b) => b.rms_mdeg - a.rms_mdeg)) {
      if (rms_mdeg > top) continue;
      const at = y(rms_mdeg);
      drawing.append(text("path", { d: `M${box.left} ${at}H${box.right}`, stroke: "#444", "stroke-dasharray": "2 3" }));
      const foot = [at - 4, at + 13].find((one) => one < box.bottom - 3 && feet.every((other) => Math.abs(one - other) > 15));
      if (foot === undefined) continue;
      feet.push(foot);
      drawing.append(text("text", { x: box.left + 6, y: foot, stroke: "#fff", "stroke-width": 3, "paint-order": "stroke" }, `${number(rms_mdeg, 3)} mdeg, ${band}`));
    }
    const here = look(chosen, where);
    if (here.rms !== null) drawing.append(text("circle", { cx: x(here.values[0]), cy: y(here.rms), r: 5, fill: "#fff", stroke: "#174a74", "stroke-width": 2.4 }));
    drawing.append(text("text", { x: (box.left + box.right) / 2, y: box.bottom + 36, "text-anchor": "middle", "font-weight": 600 }, "flywheel disks on each motor"));
    drawing.append(text("text", { x: box.left, y: 11, "font-weight": 600 }, "boresight rms (mdeg)"));
  };

  const answer = panel.querySelector(".answer");
  const list = panel.querySelector(".verdicts");
  const show = () => {
    const where = positions();
    const chosen = select.selectedIndex;
    const found = look(chosen, where);
    found.values.forEach((value, axis) => {
      const unit = units[axis].length > 1 && value !== 1 ? units[axis][1] : units[axis][0];
      const said = `${Number(value.toPrecision(4))} ${unit}`;
      sliders[axis].closest("label").querySelector("output").textContent = said;
      sliders[axis].setAttribute("aria-valuetext", said);
    });
    const small = document.createElement("small");
    answer.textContent = found.rms === null ? "unstable " : `${found.between ? number(found.rms, 4) : found.rms} mdeg `;
    small.textContent = found.rms === null ? (found.between ? "at a neighbouring table point" : "with these gains") : `boresight rms per axis${found.between ? ", interpolated" : ", as in the table"}`;
    answer.append(small);
    answer.dataset.rms = found.rms === null ? "" : found.rms;
    const lines = [["unstable", "violates a constraint (margins or control effort)", "meets every constraint on this plant"][found.state]];
    if (found.rms !== null) {
      for (const band of table.bands) {
        lines.push(`${band.name}: ${number(24 * (found.rms / band.beamwidth_mdeg) ** 2, 4)} dB mean loss over two equal axes`);
      }
      for (const budget of table.budgets) {
        lines.push(`${found.rms <= budget.rms_mdeg ? "\u2713 meets" : "\u2717 misses"} ${budget.name} (${budget.band}, ${number(budget.rms_mdeg, 3)} mdeg)`);
      }
    }
    list.replaceChildren(...lines.map((line) => Object.assign(document.createElement("li"), { textContent: line })));
    draw(chosen, where);
  };

  const nearest = (axis, value) => {
    const values = sizes[axis];
    const low = Math.max(0, values.findLastIndex((one) => one <= value + 1e-9));
    return low + (low + 1 < values.length ? (value - values[low]) / (values[low + 1] - values[low]) : 0);
  };
  [table.start.flywheel_disks_1, table.start.leakage_rate_per_s, table.start.friction_slope_N_m_s_per_rad, table.start.wind_speed_m_per_s].forEach((value, axis) => {
    sliders[axis].max = sizes[axis].length - 1;
    sliders[axis].value = nearest(axis, value);
  });
  for (const control of [select, ...sliders]) control.addEventListener("input", show);
  window.addEventListener("resize", show);
  show();
})();
