-- Stripes one scan line high, bright on every other line: nothing could flicker more.

camera{eye={0, 0, 1}, look_at={0, 0, 0}, ortho_height=raster.lines}
add(halfspace{normal={0, 0, 1}}:material{
    unlit=true, texture=stripe{{0.8, 0.8, 0.8}, {0.1, 0.1, 0.1}, axis={0, 1, 0}, size=1}})
