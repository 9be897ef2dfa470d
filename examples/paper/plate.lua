-- A zone plate that can be moved: shift= lines down, drift= pixels a field to the right, wide= times
-- stretched across, rings= times as many rings.

local lines = raster.lines
local wide, shift, drift = param.wide or 1, param.shift or 0, param.drift or 0

duration(4)
camera{eye={0, 0, 1}, look_at={0, 0, 0}, ortho_height=lines}
add(halfspace{normal={0, 0, 1}}
    :material{unlit=true, texture=zoneplate{height=lines / (param.rings or 1)}}
    :scale{wide, 1, 1}:translate{0, -shift, 0}
    :velocity{drift * raster.field_rate * raster.pixel_aspect, 0, 0})
