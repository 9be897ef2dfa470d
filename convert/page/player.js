/* The interlace player: fields at the display's rate, as a tube, bob, weave or whole frames, two clips
   side by side or as a wipe. All state is in window.weftPlayer. */
(function () {
  "use strict";
  var FADE = 0.14;                 // what is left of a tube's line after one field
  var MODES = ["crt", "bob", "weave", "frame"];
  var KEPT_BYTES = 160e6;          // of fields as R G B A, of each variant
  var root = document.getElementById("player");
  var data = JSON.parse(document.getElementById("player-data").textContent);
  if (!root || !data.clips) return;

  var screens = root.querySelector(".screens");
  var player = {
    ready: false, playing: false, tick: 0, mode: "crt", rate: 59.94, zoom: 1, clip: null, dropped: 0, shown: 0,
    layout: "side", wipe: 50, heat: false,
    panels: [0, 1].map(function (k) {
      return { variant: null, canvas: root.querySelector('canvas[data-panel="' + k + '"]'), image: null,
               screen: root.querySelector('[data-screen="' + k + '"]'), hot: null };
    })
  };
  window.weftPlayer = player;

  var faded = new Uint8ClampedArray(256);
  for (var level = 0; level < 256; level++) faded[level] = level * FADE;

  /* ---- Fields ---- */

  // A clip that goes to and fro turns around so that fields keep alternating.
  player.fieldAt = function (tick) {
    var count = player.clip.fields;
    if (!player.clip.bounce) return ((tick % count) + count) % count;
    var period = 2 * count - 2, at = ((tick % period) + period) % period;
    return at < count ? at : period - at;
  };

  // 0: its lines are the upper ones; variants may differ in their order.
  player.parity = function (field, panel) {
    var variant = player.panels[panel || 0].variant;
    return (field + (variant && "first" in variant ? variant.first : player.clip.first)) % 2;
  };

  // By line of the screen: which field drew it and how bright it is; field -1 where it is filled in.
  player.lines = function (panel) {
    var now = player.fieldAt(player.tick), before = player.fieldAt(player.tick - 1);
    if (player.mode === "frame") { before = now ^ 1; }
    var own = player.parity(now, panel), lines = [];
    for (var y = 0; y < player.clip.lines; y++) {
      if (y % 2 === own) lines.push({ field: now, gain: 1 });
      else if (player.mode === "bob") lines.push({ field: -1, gain: 1 });
      else lines.push({ field: before, gain: player.mode === "crt" ? FADE : 1 });
    }
    return lines;
  };

  // All lines of a field as bytes R G B A; those of packed clips are made when they are first shown.
  function pixels(variant, field) {
    var clip = player.clip, bytes = clip.width * clip.lines * 2;
    if (variant.pixels) return variant.pixels.subarray(field * bytes, (field + 1) * bytes);
    if (!variant.kept[field]) {
      if (variant.order.length * bytes > KEPT_BYTES) delete variant.kept[variant.order.shift()];
      variant.order.push(field);
      variant.kept[field] = window.weftUnpack.rgba(variant.unpacker.fields[field], clip.width, clip.lines / 2,
                                                   variant.widths, variant.colors);
    }
    return variant.kept[field];
  }

  // Bytes R G B A of a line of a field, as weft made it.
  player.row = function (panel, field, y) {
    var at = (y >> 1) * player.clip.width * 4;
    return pixels(player.panels[panel].variant, field).subarray(at, at + player.clip.width * 4);
  };

  function fill(panel, out, y, width, field) { // between the lines above and below
    var last = player.clip.lines - 1;
    var above = player.row(panel, field, y > 0 ? y - 1 : y + 1);
    var below = player.row(panel, field, y < last ? y + 1 : y - 1);
    for (var k = 0; k < width * 4; k++) out[y * width * 4 + k] = (above[k] + below[k]) >> 1;
  }

  function draw(panel) {
    var own = player.panels[panel], context = own.canvas.getContext("2d"), width = player.clip.width;
    if (!own.variant) return;
    if (!own.image || own.image.width !== width || own.image.height !== player.clip.lines) {
      own.image = context.createImageData(width, player.clip.lines);
    }
    var out = own.image.data, now = player.fieldAt(player.tick);
    player.lines(panel).forEach(function (line, y) {
      if (line.field < 0) { fill(panel, out, y, width, now); return; }
      var row = player.row(panel, line.field, y), at = y * width * 4;
      if (line.gain === 1) { out.set(row, at); return; }
      for (var k = 0; k < width * 4; k += 4) {
        out[at + k] = faded[row[k]];
        out[at + k + 1] = faded[row[k + 1]];
        out[at + k + 2] = faded[row[k + 2]];
        out[at + k + 3] = 255;
      }
    });
    context.putImageData(own.image, 0, 0);
  }

  function single() { return player.clip.variants.length < 2; }

  player.draw = function () {
    if (!player.ready) return;
    draw(0);
    if (!single()) draw(1);
    var field = player.fieldAt(player.tick);
    root.querySelector(".state").textContent = "frame " + (field >> 1) + ", field " + (field % 2 + 1) +
      (player.parity(field) ? " (lower lines)" : " (upper lines)");
    root.querySelector(".dropped").textContent = !player.dropped ? "" : player.dropped + " of " +
      (player.dropped + player.shown) + " fields left out: this browser is not fast enough for what it is to show";
  };

  /* ---- Time ---- */

  var started = 0, startTick = 0;

  function loop(time) {
    if (!player.playing) return;
    if (!started) { started = time; startTick = player.tick; }
    var tick = startTick + Math.floor((time - started) * player.rate / 1000);
    if (tick !== player.tick) {
      player.dropped += tick - player.tick - 1;
      player.shown += 1;
      player.tick = tick;
      player.draw();
    }
    window.requestAnimationFrame(loop);
  }

  player.play = function () {
    if (player.playing) return;
    player.playing = true;
    started = player.dropped = player.shown = 0;
    window.requestAnimationFrame(loop);
    told();
  };

  player.pause = function () { player.playing = false; told(); };

  player.stepField = function (by) { player.pause(); player.tick += by; player.draw(); };

  player.stepFrame = function (by) {
    player.pause();
    player.tick = 2 * (Math.floor(player.tick / 2) + by);
    player.draw();
  };

  function told() {
    var button = root.querySelector('[data-do="play"]');
    button.textContent = player.playing ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(player.playing));
  }

  /* ---- Loading ---- */

  function textOf(id) { return document.getElementById(id).textContent; }

  function loadSprite(variant) {
    return new Promise(function (resolve, reject) {
      var image = new Image();
      image.onload = function () {
        var canvas = document.createElement("canvas");
        canvas.width = image.naturalWidth;
        canvas.height = image.naturalHeight;
        var context = canvas.getContext("2d", { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        variant.pixels = context.getImageData(0, 0, canvas.width, canvas.height).data;
        resolve(variant);
      };
      image.onerror = function () { reject(new Error("a clip cannot be decoded")); };
      image.src = variant.sprite;
    });
  }

  // A field at a time, so that the page answers meanwhile.
  function loadPacked(variant, lines, fields) {
    var unpacker = new window.weftUnpack.Unpacker(textOf(variant.packed), { lines: lines / 2, widths: variant.widths });
    return new Promise(function (resolve) {
      function more() {
        var until = window.performance.now() + 40;
        while (!unpacker.isDone() && window.performance.now() < until) unpacker.next();
        if (!unpacker.isDone()) {
          root.querySelector(".state").textContent = "unpacking " + variant.label + ": " +
            Math.floor(100 * unpacker.fields.length / fields) + " %";
          window.setTimeout(more, 0);
          return;
        }
        unpacker.data = unpacker.models = unpacker.residuals = null;
        variant.kept = {};
        variant.order = [];
        variant.unpacker = unpacker;
        resolve(variant);
      }
      more();
    });
  }

  // Once for each variant, whoever asks.
  function load(variant) {
    if (!variant.loading) {
      variant.loading = variant.sprite ? loadSprite(variant)
        : loadPacked(variant, player.clip.lines, player.clip.fields);
    }
    return variant.loading;
  }

  /* ---- The heat map ---- */

  // From nothing through red and yellow to white.
  function heatColor(share) {
    return [Math.min(1, 3 * share), Math.min(1, Math.max(0, 3 * share - 1)), Math.max(0, 3 * share - 2)]
      .map(function (part) { return Math.round(255 * part); }).concat(Math.round(255 * Math.min(1, 3 * share)));
  }

  function heatOf(variant) {
    if (!variant.heat || variant.hot) return variant.hot;
    var width = player.clip.width, lines = player.clip.lines;
    var unpacker = new window.weftUnpack.Unpacker(textOf(variant.heat), { lines: lines, widths: [width] });
    unpacker.next();
    var image = new ImageData(width, lines), table = [];
    for (var v = 0; v < 256; v++) table.push(heatColor(v / 255));
    unpacker.fields[0][0].forEach(function (value, k) { image.data.set(table[value], 4 * k); });
    variant.hot = image;
    return image;
  }

  function heatCanvas(panel) {
    if (!panel.hot) {
      panel.hot = document.createElement("canvas");
      panel.hot.className = "heat";
      panel.hot.setAttribute("aria-hidden", "true");
      panel.screen.appendChild(panel.hot);
    }
    return panel.hot;
  }

  function drawHeat() {
    player.panels.forEach(function (panel) {
      if (!player.heat || !panel.variant) {
        if (panel.hot) panel.hot.remove();
        panel.hot = null;
        return;
      }
      var image = heatOf(panel.variant), canvas = heatCanvas(panel);
      canvas.width = player.clip.width;
      canvas.height = player.clip.lines;
      if (image) canvas.getContext("2d").putImageData(image, 0, 0);
    });
    size();
  }

  player.setHeat = function (heat) {
    player.heat = heat === true || heat === "on";
    root.classList.toggle("heated", player.heat);
    root.querySelector('[data-set="heat"]').value = player.heat ? "on" : "off";
    drawHeat();
  };

  function legend() {
    var stops = [0, 1, 2, 3].map(function (k) { return "rgba(" + heatColor(k / 3).slice(0, 3).join(",") + ")"; });
    root.classList.toggle("hot", player.clip.variants.some(function (v) { return v.heat; }));
    root.querySelector(".ramp").style.background = "linear-gradient(to right, #000, " + stops.slice(1).join(", ") + ")";
    root.querySelector(".high").textContent = (player.clip.high || 0) + " of white";
  }

  /* ---- Choices ---- */

  function named(name) {
    return player.clip.variants.filter(function (v) { return v.name === name; })[0];
  }

  player.setVariant = function (panel, name) {
    return load(named(name)).then(function (variant) {
      var own = player.panels[panel];
      own.variant = variant;
      own.canvas.setAttribute("aria-label", ["Left", "Right"][panel] + " picture: " + variant.label);
      root.querySelector('select[data-panel="' + panel + '"]').value = name;
      root.querySelectorAll(".figures")[panel].textContent = variant.figures || "";
      if (player.heat) drawHeat();
      player.draw();
    });
  };

  function setRates() {
    var rate = player.clip.rate || 59.94, select = root.querySelector('[data-set="rate"]');
    var rates = [rate, player.clip.rate ? rate / 2 : 50, 15, 4, 1].filter(function (r) { return r <= rate; });
    select.replaceChildren.apply(select, rates.map(function (r) { return new Option(+r.toFixed(2), r); }));
    player.setRate(rate);
  }

  player.setClip = function (id) {
    var kept = player.panels.map(function (p) { return p.variant && p.variant.name; });
    player.ready = false;
    player.clip = data.clips.filter(function (c) { return c.id === id; })[0];
    root.querySelector('[data-set="clip"]').value = id;
    root.classList.toggle("single", single());
    var names = player.clip.variants.map(function (v) { return v.name; });
    var wanted = [["line", names[0]], ["shaped", names[names.length - 1]]].map(function (w, k) {
      return names.indexOf(kept[k]) >= 0 ? kept[k] : names.indexOf(w[0]) >= 0 ? w[0] : w[1];
    });
    player.panels.forEach(function (panel, k) {
      panel.canvas.width = player.clip.width;
      panel.canvas.height = player.clip.lines;
      var select = root.querySelector('select[data-panel="' + k + '"]');
      select.replaceChildren.apply(select, player.clip.variants.map(function (v) {
        return new Option(v.label, v.name);
      }));
    });
    setRates();
    legend();
    player.setZoom(player.zoom);
    if (single()) wanted.pop();
    return Promise.all(wanted.map(function (name, k) { return player.setVariant(k, name); }))
      .then(function () { player.ready = true; player.draw(); });
  };

  player.setMode = function (mode) {
    player.mode = mode;
    root.querySelector('[data-set="mode"]').value = mode;
    player.draw();
  };

  player.setRate = function (rate) { player.rate = Number(rate); started = player.dropped = player.shown = 0; };

  // CSS pixels a pixel: whole numbers of the screen's. The picture fits where it can without being scaled down.
  function scale() {
    if (player.zoom !== "fit") return player.zoom * window.exactScale();
    var ratio = window.devicePixelRatio || 1;
    return Math.max(1, Math.floor((root.clientWidth - 34) * ratio / player.clip.width)) / ratio;
  }

  function size() {
    var by = scale();
    root.style.setProperty("--raster", player.clip.width * Math.min(by, window.exactScale()) + "px");
    root.style.setProperty("--shown", player.clip.width * by + "px");
    root.querySelectorAll(".screen canvas").forEach(function (canvas) {
      canvas.style.width = player.clip.width * by + "px";
      canvas.style.height = player.clip.lines * by + "px";
    });
  }

  player.setZoom = function (zoom) {
    player.zoom = zoom === "fit" ? zoom : Math.max(1, Math.min(4, Number(zoom) || 1));
    root.querySelector('[data-set="zoom"]').value = String(player.zoom);
    size();
  };

  player.setLayout = function (layout) {
    player.layout = single() ? "side" : layout;
    screens.dataset.layout = player.layout;
    root.querySelector('[data-set="layout"]').value = player.layout;
  };

  // How much of the width is the left picture's, in percent.
  player.setWipe = function (wipe) {
    player.wipe = Math.max(0, Math.min(100, Number(wipe)));
    screens.style.setProperty("--wipe", player.wipe + "%");
    root.querySelector('[data-set="wipe"]').value = String(player.wipe);
  };

  var actions = {
    play: function () { if (player.playing) player.pause(); else player.play(); },
    field: function () { player.stepField(1); },
    "field-back": function () { player.stepField(-1); },
    frame: function () { player.stepFrame(1); },
    "frame-back": function () { player.stepFrame(-1); }
  };
  var setters = { clip: player.setClip, mode: player.setMode, rate: player.setRate, zoom: player.setZoom,
                  layout: player.setLayout, wipe: player.setWipe, heat: player.setHeat };
  var keys = {
    " ": actions.play,
    "+": function () { player.setZoom((Number(player.zoom) || 0) + 1); },
    "=": function () { player.setZoom((Number(player.zoom) || 0) + 1); },
    "-": function () { player.setZoom(player.zoom - 1); },
    s: function () { player.setLayout(player.layout === "side" ? "wipe" : "side"); },
    "[": function () { player.setWipe(player.wipe - 5); },
    "]": function () { player.setWipe(player.wipe + 5); },
    h: function () { if (root.classList.contains("hot")) player.setHeat(!player.heat); }
  };
  MODES.forEach(function (mode) { keys[mode[0]] = function () { player.setMode(mode); }; });

  root.addEventListener("click", function (event) {
    var name = event.target.getAttribute("data-do");
    if (actions[name]) actions[name]();
  });
  root.addEventListener("change", function (event) {
    var set = event.target.getAttribute("data-set"), panel = event.target.getAttribute("data-panel");
    if (set) setters[set](event.target.value);
    else if (panel) player.setVariant(Number(panel), event.target.value);
  });
  root.addEventListener("input", function (event) {
    if (event.target.getAttribute("data-set") === "wipe") player.setWipe(event.target.value);
  });
  root.addEventListener("keydown", function (event) {
    if (/^(SELECT|INPUT)$/.test(event.target.tagName) || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.tagName === "BUTTON" && event.key === " ") return;
    var by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (by) { if (event.shiftKey) player.stepFrame(by); else player.stepField(by); }
    else if (keys[event.key]) keys[event.key]();
    else return;
    event.preventDefault();
  });
  window.addEventListener("resize", function () { player.setZoom(player.zoom); });

  // Both pictures show the same part, and in a wipe the boundary follows the pointer.
  player.panels.forEach(function (panel, k) {
    var other = player.panels[1 - k];
    panel.screen.addEventListener("scroll", function () {
      other.screen.scrollLeft = panel.screen.scrollLeft;
      other.screen.scrollTop = panel.screen.scrollTop;
    });
  });
  function follow(event) {
    if (player.layout !== "wipe" || !(event.buttons & 1) || event.pointerType === "touch") return;
    var box = screens.getBoundingClientRect();
    player.setWipe(100 * (event.clientX - box.left) / box.width);
  }
  player.panels[0].screen.addEventListener("pointerdown", follow);
  player.panels[0].screen.addEventListener("pointermove", follow);

  var clips = root.querySelector('[data-set="clip"]');
  data.clips.forEach(function (clip) { clips.add(new Option(clip.title, clip.id)); });
  root.classList.toggle("one", data.clips.length < 2);
  player.loaded = player.setClip(data.clips[0].id);
  // Two rasters that the window cannot hold beside each other are easier to compare as a wipe.
  if (data.fit && window.innerWidth < player.clip.width * window.exactScale() + 34) player.setZoom("fit");
  if (data.fit && window.innerWidth < 2 * player.clip.width * window.exactScale() + 90) player.setLayout("wipe");
}());
