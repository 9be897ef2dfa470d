-- Things that go to the right at a steady speed (pixels a field): a wide bar above, a thin one below,
-- or, with disc=1, a disc with eight spokes. For the eye that follows, and for the one that does not.

local lines, aspect = raster.lines, raster.pixel_aspect
local speed = (param.speed or 8) * 60000 / 1001 * aspect
local left = -raster.width * aspect / 2

duration(4)
background(0.02)
camera{eye={0, 0, lines}, look_at={0, 0, 0}, ortho_height=lines}

local function go(solid, at) add(solid:translate{left + at, 0, 0}:velocity{speed, 0, 0}) end

local white = {unlit=true, color=0.9}
if param.disc then
    local radius = 0.42 * lines
    local spokes = {}
    for n = 0, 3 do
        spokes[#spokes + 1] = box{min={-radius, -1.6, -1}, max={radius, 1.6, 1}}
            :rotate{axis={0, 0, 1}, degrees=45 * n}
    end
    local rim = cylinder{from={0, 0, -1}, to={0, 0, 1}, radius=radius} -
                cylinder{from={0, 0, -2}, to={0, 0, 2}, radius=radius - 3}
    local hub = cylinder{from={0, 0, -1.5}, to={0, 0, 1.5}, radius=0.13 * lines}
    go((rim + union(spokes)):material(white), lines / 2)
    go(hub:material{unlit=true, color={0.8, 0.25, 0.1}}, lines / 2)
else
    go(box{min={0, 0, -1}, max={40, lines, 1}}:material(white), 30)
    go(box{min={0, -lines, -1}, max={2, 0, 1}}:material(white), 30)
end
