-- Figure 6 of the paper: six figures on a carousel at 10 turns a minute, over a checkered
-- ground, with shadows. The figures are moving edges of every slope; the ground stands still.
--
--   weft render carousel.lua -o carousel.y4m
--   weft render carousel.lua --frames 0 -o still.#.png

local rpm = param.rpm or 10

duration(4)
background{0.25, 0.42, 0.72}
camera{eye={0, 5.2, 13.5}, look_at={0, 1.75, 0}, fov=33}
light{point={9, 17, 11}, color={1.0, 0.94, 0.84}}

local function paint(r, g, b) return {color={r, g, b}, specular=0.25, shininess=60} end
local brass = {color={0.86, 0.62, 0.22}, specular=0.7, shininess=90, ambient=0.14}
local wood = paint(0.42, 0.22, 0.11)
local cream = paint(0.9, 0.84, 0.7)

-- ---- A figure: a head, a body, two arms held out, two legs ----

local function figure(shirt, trousers)
    local skin = paint(0.78, 0.53, 0.38)
    local shoe = paint(0.06, 0.05, 0.05)
    local head = sphere{center={0, 1.62, 0}, radius=0.155}
    local brim = torus{center={0, 1.7, 0}, major=0.16, minor=0.035}
    local crown = cone{from={0, 1.69, 0}, to={0, 1.93, 0}, radii={0.15, 0.11}}
    local neck = cylinder{from={0, 1.4, 0}, to={0, 1.55, 0}, radius=0.06}
    local chest = ellipsoid{center={0, 1.17, 0}, radii={0.24, 0.32, 0.15}}
    local belt = cylinder{from={0, 0.84, 0}, to={0, 0.9, 0}, radius=0.2}
    local hips = ellipsoid{center={0, 0.84, 0}, radii={0.2, 0.16, 0.15}}
    local parts = {head:material(skin), (brim + crown):material(shirt), neck:material(skin),
                   chest:material(shirt), hips:material(trousers),
                   belt:scale{1, 1, 0.75}:material(brass)}
    for side = -1, 1, 2 do
        local shoulder, hand = {0.23 * side, 1.33, 0}, {0.68 * side, 1.16, 0.12}
        local elbow = {0.47 * side, 1.17, -0.03}
        local hip, knee, foot = {0.1 * side, 0.8, 0}, {0.13 * side, 0.43, 0.06 * side},
                                {0.14 * side, 0.04, 0}
        local sleeve = cone{from=shoulder, to=elbow, radii={0.085, 0.065}}
        local arm = cone{from=elbow, to=hand, radii={0.06, 0.045}}
        parts[#parts + 1] = (sleeve + sphere{center=shoulder, radius=0.088} +
                             sphere{center=elbow, radius=0.066}):material(shirt)
        parts[#parts + 1] = (arm + sphere{center=hand, radius=0.065}):material(skin)
        local thigh = cone{from=hip, to=knee, radii={0.11, 0.08}}
        local shin = cone{from=knee, to=foot, radii={0.078, 0.055}}
        parts[#parts + 1] = (thigh + shin + sphere{center=knee, radius=0.08}):material(trousers)
        local sole = ellipsoid{center={0.14 * side, 0.05, 0.06}, radii={0.075, 0.06, 0.15}}
        parts[#parts + 1] = (sole * halfspace{normal={0, -1, 0}, offset=0}):material(shoe)
    end
    return union(parts)
end

-- ---- The carousel ----

local turning = {}

local function stand(solid) turning[#turning + 1] = solid end

local deck = cylinder{from={0, 0.35, 0}, to={0, 0.6, 0}, radius=4.3}
local step = cylinder{from={0, 0.12, 0}, to={0, 0.35, 0}, radius=4.55}
stand((deck - cylinder{from={0, 0.5, 0}, to={0, 0.7, 0}, radius=1.2}):material{
    color={0.5, 0.28, 0.14}, specular=0.2,
    texture=stripe{{0.5, 0.28, 0.14}, {0.4, 0.21, 0.1}, axis={1, 0, 0}, size=0.4}})
stand(torus{center={0, 0.48, 0}, major=4.3, minor=0.1}:material(brass))
stand(step:material(paint(0.55, 0.1, 0.1)))
stand(cylinder{from={0, 0.5, 0}, to={0, 4.1, 0}, radius=0.34}:material(cream))
for n = 0, 2 do
    stand(torus{center={0, 1.2 + n, 0}, major=0.36, minor=0.07}:material(brass))
end

-- The roof: a cone with a hollow, twelve sectors red and cream, a knob on its top.
local roof = cone{from={0, 4, 0}, to={0, 5.2, 0}, radii={4.5, 0.15}} -
             cone{from={0, 3.9, 0}, to={0, 5.0, 0}, radii={4.4, 0.05}}
for n = 0, 11 do
    local turn = {axis={0, 1, 0}, degrees=30 * n}
    local wedge = halfspace{normal={0, 0, -1}} *
                  halfspace{normal={-math.sin(math.pi / 6), 0, math.cos(math.pi / 6)}}
    stand((roof * wedge:rotate(turn)):material(n % 2 == 0 and paint(0.72, 0.08, 0.07) or cream))
    stand(sphere{center={4.42, 3.94, 0}, radius=0.11}:rotate(turn):material(brass))
end
stand(sphere{center={0, 5.3, 0}, radius=0.22}:material(brass))

local clothes = {{{0.75, 0.1, 0.08}, {0.1, 0.12, 0.3}}, {{0.08, 0.4, 0.2}, {0.35, 0.28, 0.2}},
                 {{0.1, 0.25, 0.65}, {0.75, 0.72, 0.66}}, {{0.85, 0.6, 0.08}, {0.16, 0.1, 0.1}},
                 {{0.5, 0.12, 0.5}, {0.2, 0.25, 0.22}}, {{0.85, 0.85, 0.82}, {0.55, 0.1, 0.1}}}
for n = 0, 5 do
    local turn = {axis={0, 1, 0}, degrees=60 * n + 12}
    local shirt, trousers = clothes[n + 1][1], clothes[n + 1][2]
    local person = figure(paint(table.unpack(shirt)), paint(table.unpack(trousers)))
    stand(person:translate{0, 0.6, 3.35}:rotate(turn))
    stand(cylinder{from={0, 0.6, 2.6}, to={0, 4.1, 2.6}, radius=0.05}:rotate(turn):material(brass))
end

for _, solid in ipairs(turning) do add(solid:spin{axis={0, 1, 0}, rpm=rpm}) end

-- ---- The ground ----

add(halfspace{normal={0, 1, 0}, offset=0}:material{
    texture=checker{{0.62, 0.66, 0.5}, {0.2, 0.36, 0.16}, size=1.5}, diffuse=0.85})
