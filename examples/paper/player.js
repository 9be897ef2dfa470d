/* The interlace player: fields at the display's rate, as a tube, bob, weave or whole frames. All state is
   in window.weftPlayer. */
(function () {
  "use strict";
  var FADE = 0.14;                 // what is left of a tube's line after one field
  var MODES = ["crt", "bob", "weave", "frame"];
  var root = document.getElementById("player");
  var data = JSON.parse(document.getElementById("player-data").textContent);
  if (!root || !data.clips) return;

  var player = {
    ready: false, playing: false, tick: 0, mode: "crt", rate: 59.94, zoom: 1, clip: null, dropped: 0, shown: 0,
    panels: [0, 1].map(function (k) {
      return { variant: null, canvas: root.querySelector('canvas[data-panel="' + k + '"]') };
    })
  };
  window.weftPlayer = player;

  /* ---- Fields ---- */

  // A clip that goes to and fro turns around so that fields keep alternating.
  player.fieldAt = function (tick) {
    var count = player.clip.fields;
    if (!player.clip.bounce) return ((tick % count) + count) % count;
    var period = 2 * count - 2, at = ((tick % period) + period) % period;
    return at < count ? at : period - at;
  };

  player.parity = function (field) { return (field + player.clip.first) % 2; };

  // By line of the screen: which field drew it and how bright it is; field -1 where it is filled in.
  player.lines = function () {
    var now = player.fieldAt(player.tick), before = player.fieldAt(player.tick - 1);
    if (player.mode === "frame") { before = now ^ 1; }
    var own = player.parity(now), lines = [];
    for (var y = 0; y < player.clip.lines; y++) {
      if (y % 2 === own) lines.push({ field: now, gain: 1 });
      else if (player.mode === "bob") lines.push({ field: -1, gain: 1 });
      else lines.push({ field: before, gain: player.mode === "crt" ? FADE : 1 });
    }
    return lines;
  };

  // Bytes R G B A of a line of a field, as weft made it.
  player.row = function (panel, field, y) {
    var variant = player.panels[panel].variant, width = player.clip.width;
    var at = (field * player.clip.lines / 2 + (y >> 1)) * width * 4;
    return variant.pixels.subarray(at, at + width * 4);
  };

  function fill(panel, out, y, width, field) { // between the lines above and below
    var last = player.clip.lines - 1;
    var above = player.row(panel, field, y > 0 ? y - 1 : y + 1);
    var below = player.row(panel, field, y < last ? y + 1 : y - 1);
    for (var k = 0; k < width * 4; k++) out[y * width * 4 + k] = (above[k] + below[k]) >> 1;
  }

  function draw(panel) {
    var canvas = player.panels[panel].canvas, context = canvas.getContext("2d");
    var width = player.clip.width, image = context.createImageData(width, player.clip.lines);
    var now = player.fieldAt(player.tick);
    player.lines().forEach(function (line, y) {
      if (line.field < 0) { fill(panel, image.data, y, width, now); return; }
      var row = player.row(panel, line.field, y), at = y * width * 4;
      if (line.gain === 1) { image.data.set(row, at); return; }
      for (var k = 0; k < width * 4; k++) {
        image.data[at + k] = (k & 3) === 3 ? 255 : row[k] * line.gain;
      }
    });
    context.putImageData(image, 0, 0);
  }

  player.draw = function () {
    if (!player.ready) return;
    draw(0);
    draw(1);
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

  /* ---- Choices ---- */

  function load(variant) {
    if (variant.pixels) return Promise.resolve(variant);
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

  function named(name) {
    return player.clip.variants.filter(function (v) { return v.name === name; })[0];
  }

  player.setVariant = function (panel, name) {
    return load(named(name)).then(function (variant) {
      player.panels[panel].variant = variant;
      root.querySelector('select[data-panel="' + panel + '"]').value = name;
      player.draw();
    });
  };

  player.setClip = function (id) {
    var kept = player.panels.map(function (p) { return p.variant && p.variant.name; });
    player.ready = false;
    player.clip = data.clips.filter(function (c) { return c.id === id; })[0];
    root.querySelector('[data-set="clip"]').value = id;
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
    player.setZoom(player.zoom);
    return Promise.all(wanted.map(function (name, k) { return player.setVariant(k, name); }))
      .then(function () { player.ready = true; player.draw(); });
  };

  player.setMode = function (mode) {
    player.mode = mode;
    root.querySelector('[data-set="mode"]').value = mode;
    player.draw();
  };

  player.setRate = function (rate) { player.rate = Number(rate); started = player.dropped = player.shown = 0; };

  player.setZoom = function (zoom) {
    player.zoom = Math.max(1, Math.min(4, Number(zoom)));
    root.querySelector('[data-set="zoom"]').value = String(player.zoom);
    root.style.setProperty("--raster", player.clip.width * window.exactScale() + "px");
    player.panels.forEach(function (panel) {
      panel.canvas.style.width = player.clip.width * player.zoom * window.exactScale() + "px";
      panel.canvas.style.height = player.clip.lines * player.zoom * window.exactScale() + "px";
    });
  };

  var actions = {
    play: function () { if (player.playing) player.pause(); else player.play(); },
    field: function () { player.stepField(1); }, "field-back": function () { player.stepField(-1); },
    frame: function () { player.stepFrame(1); }, "frame-back": function () { player.stepFrame(-1); }
  };
  var setters = { clip: player.setClip, mode: player.setMode, rate: player.setRate, zoom: player.setZoom };

  root.addEventListener("click", function (event) {
    var name = event.target.getAttribute("data-do");
    if (actions[name]) actions[name]();
  });
  root.addEventListener("change", function (event) {
    var set = event.target.getAttribute("data-set"), panel = event.target.getAttribute("data-panel");
    if (set) setters[set](event.target.value);
    else if (panel) player.setVariant(Number(panel), event.target.value);
  });
  root.addEventListener("keydown", function (event) {
    if (event.target.tagName === "SELECT" || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.tagName === "BUTTON" && event.key === " ") return;
    var key = event.key, mode = MODES.filter(function (m) { return m[0] === key; })[0];
    var by = key === "ArrowRight" ? 1 : key === "ArrowLeft" ? -1 : 0;
    if (key === " ") actions.play();
    else if (by) { if (event.shiftKey) player.stepFrame(by); else player.stepField(by); }
    else if (mode) player.setMode(mode);
    else if (key === "+" || key === "=") player.setZoom(player.zoom + 1);
    else if (key === "-") player.setZoom(player.zoom - 1);
    else return;
    event.preventDefault();
  });
  window.addEventListener("resize", function () { player.setZoom(player.zoom); });

  var clips = root.querySelector('[data-set="clip"]');
  data.clips.forEach(function (clip) { clips.add(new Option(clip.title, clip.id)); });
  player.loaded = player.setClip(data.clips[0].id);
}());
