-- Four balls thrown past at one speed (pixels a field), each with a temporal width of its own.

local lines = raster.lines
local widths = {0, 0.5, 1, 2}
local speed = (param.speed or 20) * raster.field_rate * raster.pixel_aspect

duration(1)
background(0.03)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
light{direction={0.4, -1, -1.3}}
local colors = {{0.85, 0.3, 0.12}, {0.85, 0.65, 0.1}, {0.2, 0.6, 0.35}, {0.25, 0.45, 0.8}}
for n, width in ipairs(widths) do
    local ball = sphere{radius=0.09 * lines}
    local look = param.flat and {unlit=true, color=0.9} or {color=colors[n], specular=0.5, ambient=0.25}
    add(ball:translate{-0.3 * raster.width * raster.pixel_aspect, (2.5 - n) * lines / 4.2, 0}
        :velocity{speed, 0, 0}:material(look):temporal_width(width))
end
