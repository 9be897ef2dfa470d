-- For the player: slanted bars that sink `speed` lines (1) a frame and are back where they were after `period`
-- frames.

local lines, period = raster.lines, param.period or 16
local speed = param.speed or 1 -- lines a frame
local slopes = {0, 0.03, 0.08, 0.25}
local width = raster.width * raster.pixel_aspect / #slopes

duration(4)
background(0.03)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}
for n, slope in ipairs(slopes) do
    local half = width / 2 - 2
    for k = -lines // period - 2, lines // period + 4 do
        local bar = polyhedron{planes={{slope, -1, 0, -k * period}, {-slope, 1, 0, k * period + period / 2},
                                       {1, 0, 0, half}, {-1, 0, 0, half}, {0, 0, 1, 1}, {0, 0, -1, 1}}}
        add(bar:velocity{0, -speed * raster.frame_rate, 0}:translate{(n - 2.5) * width, 0, 0}
            :material{unlit=true, color=0.8})
    end
end
