-- Rapid periodic motion (section 4 of the paper): a spoked wheel at 150 turns a minute that rolls
-- along, and a bird whose wings beat 25 times a second. Look at it with temporal widths from 0
-- (the wheel stands still or turns backwards) to 2 (the spokes are a haze).
--
--   weft render wheel.lua --temporal-width 0.5 -o wheel.y4m

local rpm = param.rpm or 150
local beats = param.beats or 25

duration(4)
background{0.45, 0.62, 0.85}
camera{eye={0, 1.5, 11}, look_at={0, 1.9, 0}, fov=34}
light{point={6, 14, 12}, color={1, 0.96, 0.9}}
light{direction={1, -0.4, -1}, color=0.12, shadows=false}

-- ---- The wheel: it rolls without slipping, and starts again from the left ----

local radius = 1.5
local rubber = {color={0.06, 0.06, 0.07}, specular=0.3}
local steel = {color={0.7, 0.72, 0.75}, specular=0.8, shininess=80}
local red = {color={0.75, 0.07, 0.05}, specular=0.3}

local wheel = {torus{axis={0, 0, 1}, major=radius - 0.12, minor=0.12}:material(rubber),
               torus{axis={0, 0, 1}, major=radius - 0.26, minor=0.05}:material(red),
               cylinder{from={0, 0, -0.16}, to={0, 0, 0.16}, radius=0.22}:material(red),
               sphere{center={0, 0, 0.14}, radius=0.14}:material(steel)}
for n = 0, 7 do
    wheel[#wheel + 1] = cylinder{from={0, 0.15, 0}, to={0, radius - 0.24, 0}, radius=0.045}
        :rotate{axis={0, 0, 1}, degrees=45 * n}:material(n == 0 and red or steel)
end
local way = 2 * math.pi * radius * rpm / 60 -- units a second
local speed = param.speed or 1.2            -- slower than it rolls: a treadmill's wheel
add(union(wheel):spin{axis={0, 0, 1}, rpm=-rpm}:translate{-2.2, radius, 0}:velocity{speed, 0, 0})

-- ---- The bird: wings turn back and forth about its back, by keyframes ----

local feather = {color={0.92, 0.9, 0.86}}
local beak = {color={0.9, 0.55, 0.1}}
local seconds, keys = 4, {}
for n = 0, 2 * beats * seconds do
    keys[n + 1] = {time=n / (2 * beats), axis={1, 0, 0}, degrees=n % 2 == 0 and 50 or -32}
end
local mirrored = {}
for n, key in ipairs(keys) do
    mirrored[n] = {time=key.time, axis=key.axis, degrees=-key.degrees}
end
local wing = ellipsoid{center={0, 0, 0.62}, radii={0.24, 0.03, 0.62}}:material(feather)
local body = union(ellipsoid{radii={0.5, 0.17, 0.17}}, sphere{center={0.5, 0.1, 0}, radius=0.14},
                   cone{from={-0.42, 0, 0}, to={-0.85, 0.06, 0}, radii={0.1, 0.16}}):material(feather)
local bill = cone{from={0.6, 0.1, 0}, to={0.82, 0.07, 0}, radii={0.05, 0.005}}:material(beak)
local bird = union(body, bill, wing:keyframes(mirrored), wing:scale{1, 1, -1}:keyframes(keys))
add(bird:rotate{axis={0, 1, 0}, degrees=-25}:translate{1.6, 3.3, 0}:velocity{-0.35, 0.05, 0})

-- ---- The road ----

add(halfspace{normal={0, 1, 0}}:material{texture=stripe{{0.3, 0.31, 0.33}, {0.36, 0.37, 0.39},
    axis={1, 0, 0}, size=1}})
add(box{min={-30, 0, -4}, max={30, 0.5, -3.8}}:material{
    texture=stripe{{0.85, 0.85, 0.82}, {0.7, 0.12, 0.1}, axis={1, 0, 0}, size=0.8}})
