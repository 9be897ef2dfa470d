/* Shows pictures that must not be scaled at whole numbers of the screen's pixels a pixel, whatever the
   screen: a browser that scales fine rings adds aliases of its own. */
(function () {
  "use strict";

  // CSS pixels a pixel of a picture: 1, or what makes it the nearest whole number of the screen's.
  window.exactScale = function () {
    var ratio = window.devicePixelRatio || 1;
    return Math.max(1, Math.round(ratio)) / ratio;
  };

  function fit(image) {
    image.style.width = image.naturalWidth * window.exactScale() + "px";
    image.style.height = image.naturalHeight * window.exactScale() + "px";
  }

  function fitAll() {
    document.querySelectorAll("img.exact").forEach(function (image) {
      if (image.complete) fit(image);
      else image.addEventListener("load", function () { fit(image); });
    });
  }

  window.addEventListener("resize", fitAll);
  fitAll();
}());
