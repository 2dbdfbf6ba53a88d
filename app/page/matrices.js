"use strict";
// Eigenvalues and exponentials of small real matrices, as arrays of Float64Array rows.
const Matrices = (() => {
  const zeros = (rows, columns) => Array.from({ length: rows }, () => new Float64Array(columns));
  const copied = (a) => a.map((row) => row.slice());

  const product = (a, b) => {
    const result = zeros(a.length, b[0].length);
    a.forEach((row, i) => {
      for (let k = 0; k < b.length; ++k) {
        const factor = row[k];
        if (factor === 0) continue;
        for (let j = 0; j < b[k].length; ++j) result[i][j] += factor * b[k][j];
      }
    });
    return result;
  };

  // Scales rows and columns by powers of 2 until their norms agree within 2 (B. N. Parlett,
  // C. Reinsch, Numerische Mathematik 13, 1969); the scales are returned.
  const balance = (a) => {
    const n = a.length, scale = new Float64Array(n).fill(1);
    for (let done = false; !done; ) {
      done = true;
      for (let i = 0; i < n; ++i) {
        let column = 0, row = 0;
        for (let j = 0; j < n; ++j) {
          if (j === i) continue;
          column += Math.abs(a[j][i]);
          row += Math.abs(a[i][j]);
        }
        if (column === 0 || row === 0) continue;
        const factor = 2 ** Math.round(0.5 * Math.log2(row / column));
        if (column * factor + row / factor >= 0.95 * (column + row)) continue;
        done = false;
        scale[i] *= factor;
        for (let j = 0; j < n; ++j) a[i][j] /= factor;
        for (let j = 0; j < n; ++j) a[j][i] *= factor;
      }
    }
    return scale;
  };

  // To upper Hessenberg form by Householder's reflections.
  const reduce = (a) => {
    const n = a.length, v = new Float64Array(n);
    for (let k = 0; k + 2 < n; ++k) {
      let square = 0;
      for (let i = k + 1; i < n; ++i) square += a[i][k] ** 2;
      if (square === a[k + 1][k] ** 2) continue;
      const length = a[k + 1][k] > 0 ? -Math.sqrt(square) : Math.sqrt(square);
      for (let i = k + 1; i < n; ++i) v[i] = a[i][k];
      v[k + 1] -= length;
      const factor = 1 / (length * (length - a[k + 1][k]));
      for (let j = k; j < n; ++j) {
        let sum = 0;
        for (let i = k + 1; i < n; ++i) sum += v[i] * a[i][j];
        for (let i = k + 1; i < n; ++i) a[i][j] -= factor * sum * v[i];
      }
      for (let i = 0; i < n; ++i) {
        let sum = 0;
        for (let j = k + 1; j < n; ++j) sum += a[i][j] * v[j];
        for (let j = k + 1; j < n; ++j) a[i][j] -= factor * sum * v[j];
      }
      for (let i = k + 2; i < n; ++i) a[i][k] = 0;
    }
  };

  // One double step of Francis's QR with the shifts x, y, w on rows l to last.
  const francis = (a, l, last, [x, y, w]) => {
    let m = last - 2, p = 0, q = 0, r = 0;
    for (; m >= l; --m) {
      const z = a[m][m], dx = x - z, dy = y - z;
      p = (dx * dy - w) / a[m + 1][m] + a[m][m + 1];
      q = a[m + 1][m + 1] - z - dx - dy;
      r = a[m + 2][m + 1];
      const s = Math.abs(p) + Math.abs(q) + Math.abs(r);
      p /= s;
      q /= s;
      r /= s;
      if (m === l) break;
      const small = Math.abs(a[m][m - 1]) * (Math.abs(q) + Math.abs(r));
      const large = Math.abs(p) * (Math.abs(a[m - 1][m - 1]) + Math.abs(z) + Math.abs(a[m + 1][m + 1]));
      if (small + large === large) break;
    }
    for (let i = m + 2; i <= last; ++i) {
      a[i][i - 2] = 0;
      if (i > m + 2) a[i][i - 3] = 0;
    }
    for (let k = m; k < last; ++k) {
      const three = k < last - 1;
      let size = 1;
      if (k > m) {
        p = a[k][k - 1];
        q = a[k + 1][k - 1];
        r = three ? a[k + 2][k - 1] : 0;
        size = Math.abs(p) + Math.abs(q) + Math.abs(r);
        if (size === 0) continue;
        p /= size;
        q /= size;
        r /= size;
      }
      const s = (p < 0 ? -1 : 1) * Math.sqrt(p * p + q * q + r * r);
      if (s === 0) continue;
      if (k > m) a[k][k - 1] = -s * size;
      else if (l < m) a[k][k - 1] = -a[k][k - 1];
      p += s;
      const u = p / s, v = q / s, z = r / s;
      q /= p;
      r /= p;
      for (let j = k; j <= last; ++j) {
        const sum = a[k][j] + q * a[k + 1][j] + (three ? r * a[k + 2][j] : 0);
        a[k][j] -= sum * u;
        a[k + 1][j] -= sum * v;
        if (three) a[k + 2][j] -= sum * z;
      }
      for (let i = l; i <= Math.min(last, k + 3); ++i) {
        const sum = u * a[i][k] + v * a[i][k + 1] + (three ? z * a[i][k + 2] : 0);
        a[i][k] -= sum;
        a[i][k + 1] -= sum * q;
        if (three) a[i][k + 2] -= sum * r;
      }
    }
  };

  // Eigenvalues { re, im } by Francis's double-shift QR (J. G. F. Francis, Computer Journal 4,
  // 1961; EISPACK's hqr).
  const eigenvalues = (matrix) => {
    const a = copied(matrix), values = [];
    balance(a);
    reduce(a);
    let norm = 0;
    for (const row of a) for (const value of row) norm += Math.abs(value);
    let last = a.length - 1, shifted = 0;
    for (let round = 0; last >= 0; ) {
      let l = last;
      for (; l > 0; --l) {
        const beside = Math.abs(a[l - 1][l - 1]) + Math.abs(a[l][l]) || norm;
        if (Math.abs(a[l][l - 1]) + beside === beside) break;
      }
      let x = a[last][last];
      if (l === last) {
        values.push({ re: x + shifted, im: 0 });
        last -= 1;
        round = 0;
        continue;
      }
      let y = a[last - 1][last - 1], w = a[last][last - 1] * a[last - 1][last];
      if (l === last - 1) {
        const p = 0.5 * (y - x), q = p * p + w, root = Math.sqrt(Math.abs(q));
        x += shifted;
        if (q < 0) {
          values.push({ re: x + p, im: root }, { re: x + p, im: -root });
        } else {
          const z = p + (p < 0 ? -root : root);
          values.push({ re: x + z, im: 0 }, { re: z === 0 ? x : x - w / z, im: 0 });
        }
        last -= 2;
        round = 0;
        continue;
      }
      if (round === 60) throw new Error("eigenvalues: QR does not converge");
      if (round > 0 && round % 10 === 0) {
        shifted += x;
        for (let i = 0; i <= last; ++i) a[i][i] -= x;
        const s = Math.abs(a[last][last - 1]) + Math.abs(a[last - 1][last - 2]);
        x = y = 0.75 * s;
        w = -0.4375 * s * s;
      }
      ++round;
      francis(a, l, last, [x, y, w]);
    }
    return values;
  };

  // Solves a x = b by elimination with partial pivoting; both are overwritten.
  const solve = (a, b) => {
    const n = a.length;
    for (let k = 0; k < n; ++k) {
      let pivot = k;
      for (let i = k + 1; i < n; ++i) if (Math.abs(a[i][k]) > Math.abs(a[pivot][k])) pivot = i;
      [a[k], a[pivot]] = [a[pivot], a[k]];
      [b[k], b[pivot]] = [b[pivot], b[k]];
      for (let i = k + 1; i < n; ++i) {
        const factor = a[i][k] / a[k][k];
        if (factor === 0) continue;
        for (let j = k + 1; j < n; ++j) a[i][j] -= factor * a[k][j];
        for (let j = 0; j < n; ++j) b[i][j] -= factor * b[k][j];
      }
    }
    for (let k = n - 1; k >= 0; --k) {
      for (let j = 0; j < n; ++j) {
        for (let i = k + 1; i < n; ++i) b[k][j] -= a[k][i] * b[i][j];
        b[k][j] /= a[k][k];
      }
    }
    return b;
  };

  // exp(matrix) of the balanced matrix by the [8/8] Pade approximant with scaling and squaring
  // (C. Moler, C. Van Loan, SIAM Review 45, 2003, method 3).
  const exponential = (matrix) => {
    const a = copied(matrix), n = a.length, degree = 8;
    const scale = balance(a);
    const norm = Math.max(...a.map((row) => row.reduce((sum, value) => sum + Math.abs(value), 0)));
    const squarings = Math.max(0, Math.ceil(Math.log2(norm || 1)) + 1);
    for (const row of a) for (let j = 0; j < n; ++j) row[j] /= 2 ** squarings;
    const numerator = zeros(n, n), denominator = zeros(n, n);
    let power = zeros(n, n), coefficient = 1;
    for (let i = 0; i < n; ++i) numerator[i][i] = denominator[i][i] = power[i][i] = 1;
    for (let k = 1; k <= degree; ++k) {
      coefficient *= (degree - k + 1) / (k * (2 * degree - k + 1));
      power = product(power, a);
      for (let i = 0; i < n; ++i) {
        for (let j = 0; j < n; ++j) {
          numerator[i][j] += coefficient * power[i][j];
          denominator[i][j] += (k % 2 === 0 ? coefficient : -coefficient) * power[i][j];
        }
      }
    }
    let result = solve(denominator, numerator);
    for (let k = 0; k < squarings; ++k) result = product(result, result);
    for (let i = 0; i < n; ++i) for (let j = 0; j < n; ++j) result[i][j] *= scale[i] / scale[j];
    return result;
  };

  return { zeros, product, eigenvalues, exponential };
})();
