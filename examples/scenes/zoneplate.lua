-- The zone plate of Figures 4, 5 and 8: 1/2 + 1/2 cos(pi r^2 / H), r in frame lines from the
-- middle of the picture, so that the pattern reaches 0.5 cycles a line at its upper and lower
-- edge. Rings are round on the display. Still, unlit, gray: what moves in it is alias.
--
--   weft render zoneplate.lua --aperture box --temporal-width 0 -o zoneplate.####.exr

local lines = raster.lines

duration(param.seconds or 1)
camera{eye={0, 0, 1}, look_at={0, 0, 0}, ortho_height=lines}

add(halfspace{normal={0, 0, 1}}:material{unlit=true, texture=zoneplate{height=lines}})
