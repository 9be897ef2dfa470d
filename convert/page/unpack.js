/* Unpacks fields that pack.c has packed, number by number as it does (README.md has the format), and
   makes R G B A of them in whole numbers. */
(function () {
  "use strict";
  var DIRECT = 24, SYMBOLS = 31, STRIDE = 32, CONTEXTS = 256, BITS = 12, SLOTS = 1 << BITS;
  var LOW = 8388608;               // a state is at least this
  var WIDE_BASE = [24, 32, 48, 80, 144, 256, 512], WIDE_BITS = [3, 4, 5, 6, 7, 8, 9];

  function levels(ends, most) {    // the level of every sum up to most, and of all above it
    var table = new Uint8Array(most + 1);
    for (var sum = 0; sum <= most; sum++) {
      table[sum] = ends.filter(function (end) { return sum >= end; }).length;
    }
    return table;
  }
  var LEVEL = levels([1, 2, 4, 7, 12, 20, 40], 40), ALIKE = levels([1, 3, 8], 8);

  function base(symbol) { return symbol < DIRECT ? symbol : WIDE_BASE[symbol - DIRECT]; }

  /* ---- What is likely ---- */

  function Model() {
    this.count = new Float64Array(CONTEXTS * STRIDE);
    this.seen = new Uint32Array(CONTEXTS * STRIDE);
    this.share = new Uint16Array(CONTEXTS * STRIDE);
    this.before = new Uint16Array(CONTEXTS * STRIDE);
    this.slot = new Uint8Array(CONTEXTS * SLOTS);  // the symbol of every slot of every context
    for (var context = 0; context < CONTEXTS; context++) {
      var spread = (context >> 5) + (context >> 2) % 8, wide = (spread * spread >> 1) + 1;
      for (var s = 0; s < SYMBOLS; s++) {
        var all = wide + base(s) * base(s);
        this.count[context * STRIDE + s] = 1 + Math.floor(256 * wide * wide / (all * all));
      }
      this.shareOut(context);
    }
  }

  Model.prototype.shareOut = function (context) {
    var at = context * STRIDE, total = 0, left = SLOTS, most = 0, before = 0, s;
    for (s = 0; s < SYMBOLS; s++) total += this.count[at + s];
    for (s = 0; s < SYMBOLS; s++) {
      this.share[at + s] = 1 + Math.floor(this.count[at + s] * (SLOTS - SYMBOLS) / total);
      left -= this.share[at + s];
      if (this.count[at + s] > this.count[at + most]) most = s;
    }
    this.share[at + most] += left;
    for (s = 0; s < SYMBOLS; s++) {
      this.before[at + s] = before;
      this.slot.fill(s, context * SLOTS + before, context * SLOTS + before + this.share[at + s]);
      before += this.share[at + s];
    }
  };

  Model.prototype.learn = function () {
    for (var context = 0; context < CONTEXTS; context++) {
      var at = context * STRIDE, seen = 0, s;
      for (s = 0; s < SYMBOLS; s++) seen += this.seen[at + s];
      if (!seen) continue;
      for (s = 0; s < SYMBOLS; s++) {
        this.count[at + s] += 16 * this.seen[at + s] - Math.floor(this.count[at + s] / 4);
      }
      this.shareOut(context);
    }
    this.seen.fill(0);
  };

  /* ---- Fields ---- */

  function bytesOf(base64) {
    var text = window.atob(base64), bytes = new Uint8Array(text.length);
    for (var k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
    return bytes;
  }

  // shape: lines of a field, and the widths of its planes. Fields come one with each call of next().
  function Unpacker(base64, shape) {
    this.data = bytesOf(base64);
    this.at = 0;
    this.shape = shape;
    this.models = shape.widths.map(function () { return new Model(); });
    this.fields = [];              // of planes
    this.residuals = [];           // of the last three fields
  }

  Unpacker.prototype.isDone = function () { return this.at >= this.data.length; };

  Unpacker.prototype.next = function () {
    var lines = this.shape.lines, data = this.data;
    this.state = (data[this.at] * 16777216) + (data[this.at + 1] << 16 | data[this.at + 2] << 8 | data[this.at + 3]);
    this.at += 4;
    var planes = [], residuals = [];
    this.shape.widths.forEach(function (width, p) {
      planes.push(new Uint16Array(width * lines));
      residuals.push(new Uint16Array(width * lines));
      this.plane(p, planes, residuals);
    }, this);
    this.models.forEach(function (model) { model.learn(); });
    this.fields.push(planes);
    this.residuals.push(residuals);
    if (this.residuals.length > 2) this.residuals.shift();
  };

  Unpacker.prototype.plane = function (p, planes, residuals) {
    var widths = this.shape.widths, width = widths[p], fine = widths[0], step = fine / width;
    var q = planes[p], r = residuals[p], data = this.data, at = this.at, state = this.state;
    var n = this.fields.length, model = this.models[p];
    var old = n > 1 ? this.fields[n - 2][p] : null;
    var oldResidual = n > 1 ? this.residuals[0][0] : null;
    var r0 = residuals[0], r1 = residuals[1];
    var share = model.share, before = model.before, slot = model.slot, seen = model.seen;
    for (var y = 0, k = 0; y < this.shape.lines; y++) {
      for (var x = 0; x < width; x++, k++) {
        /* The guess, and how much varies of what made it. */
        var up = k - width, last = x + 1 === width;
        var left = x ? q[k - 1] : y ? q[up] : 128, above = y ? q[up] : left;
        var corner = y && x ? q[up - 1] : above, right = y && !last ? q[up + 1] : above;
        var varies = Math.abs(left - above) + Math.abs(above - corner) + Math.abs(above - right);
        var low = left < above ? left : above, high = left < above ? above : left;
        var guess = left + above - corner;
        if (guess < low) guess = low; else if (guess > high) guess = high;
        if (old && y && x) {
          var moves = Math.abs(left - old[k - 1]) + Math.abs(above - old[up]) +
              Math.abs(corner - old[up - 1]) + (last ? 0 : Math.abs(right - old[up + 1]));
          if (moves < varies) { varies = moves; guess = old[k]; }
        }
        /* The context. */
        var beside = (x ? r[k - 1] : 0) + (y ? r[up] : 0), alike = 0;
        var f = y * fine + x * step, next = x * step + 1 < fine ? f + 1 : f;
        if (p === 1) alike = r0[f] + r0[next];
        else if (p === 2) alike = 2 * r1[y * widths[1] + x] + (r0[f] >> 1);
        else if (oldResidual) alike = oldResidual[f] + (next > f ? oldResidual[next] : 0);
        var context = (LEVEL[varies < 40 ? varies : 40] << 5) + (LEVEL[beside < 40 ? beside : 40] << 2) +
            ALIKE[alike < 8 ? alike : 8];
        /* The residual. */
        var low12 = state & (SLOTS - 1), s = slot[(context << BITS) + low12], index = context * STRIDE + s;
        seen[index]++;
        state = share[index] * (state >>> BITS) + low12 - before[index];
        while (state < LOW) state = state << 8 | data[at++];
        if (s >= DIRECT) {
          var extra = WIDE_BITS[s - DIRECT];
          s = WIDE_BASE[s - DIRECT] + (state & ((1 << extra) - 1));
          state >>>= extra;
          while (state < LOW) state = state << 8 | data[at++];
        }
        r[k] = s;
        q[k] = guess + (s & 1 ? -(s + 1) >> 1 : s >> 1);
      }
    }
    this.at = at;
    this.state = state;
  };

  /* ---- Colors ---- */

  // Bytes R G B A of a field. colors: [code of black, and times 65536 the weights of luma, of Cr in red, of Cb
  // and Cr in green, of Cb in blue], or null where planes are G, R - G and B - G.
  function rgba(planes, width, lines, widths, colors) {
    var out = new Uint8ClampedArray(width * lines * 4), step = width / widths[1];
    for (var y = 0, k = 0; y < lines; y++) {
      var row = y * widths[1];
      for (var x = 0; x < width; x++, k++) {
        var c = row + (step === 2 ? x >> 1 : x), luma = planes[0][k], cb = planes[1][c], cr = planes[2][c];
        if (!colors) {
          out[4 * k] = (luma + cb) & 255;
          out[4 * k + 1] = luma;
          out[4 * k + 2] = (luma + cr) & 255;
          out[4 * k + 3] = 255;
          continue;
        }
        if (step === 2 && (x & 1) && x + 1 < width) {
          cb = (cb + planes[1][c + 1] + 1) >> 1;
          cr = (cr + planes[2][c + 1] + 1) >> 1;
        }
        luma = (luma - colors[0]) * colors[1] + 32768;
        cb -= 128;
        cr -= 128;
        out[4 * k] = (luma + cr * colors[2]) >> 16;
        out[4 * k + 1] = (luma - cb * colors[3] - cr * colors[4]) >> 16;
        out[4 * k + 2] = (luma + cb * colors[5]) >> 16;
        out[4 * k + 3] = 255;
      }
    }
    return out;
  }

  window.weftUnpack = { Unpacker: Unpacker, rgba: rgba };
}());
