-- Everything at once: every solid, all of CSG, every texture, mirrors, glass, a spot light, a
-- camera that travels, and temporal widths of their own: the propeller is sharper than the
-- picture, the fountain softer.
--
--   weft render panorama.lua -o panorama.y4m

duration(6)
background{0.32, 0.5, 0.78}
camera{eye={-1.5, 3.4, 15}, look_at={0, 1.9, 0}, fov=36}:spin{axis={0, 1, 0}, rpm=1.2}
light{point={12, 20, 14}, color={0.95, 0.9, 0.82}}
light{point={-7, 9, 5}, look_at={-4.2, 0.5, 1}, inner=14, outer=22, color={0.9, 0.75, 0.4}}
light{direction={0.4, -1, -0.7}, color=0.1, shadows=false}

local function paint(r, g, b) return {color={r, g, b}, specular=0.3, shininess=50} end
local gold = {color={0.85, 0.6, 0.2}, specular=0.8, shininess=90, reflect=0.15}
local chrome = {color={0.08, 0.08, 0.09}, specular=0.9, shininess=200, reflect=0.75}
local stone = {color={0.62, 0.6, 0.55}}

-- ---- Ground and lake ----

local lake = cylinder{from={0, -0.4, 3.6}, to={0, 0.4, 3.6}, radius=2.6}:scale{1.7, 1, 1}
add((halfspace{normal={0, 1, 0}} - lake):material{
    texture=checker{{0.4, 0.52, 0.26}, {0.34, 0.46, 0.22}, size=2}})
add((halfspace{normal={0, 1, 0}, offset=-0.12} * lake):material{
    color={0.03, 0.09, 0.11}, reflect=0.55, specular=0.8, shininess=300})

-- ---- A temple: columns, steps, a roof from planes, a zone plate as its rose window ----

local temple = {}
for x = -2, 2 do
    local shaft = cone{from={x, 0.5, 0}, to={x, 2.9, 0}, radii={0.26, 0.2}}
    local flutes = {}
    for n = 0, 9 do
        flutes[#flutes + 1] = cylinder{from={x + 0.27, 0.6, 0}, to={x + 0.22, 2.8, 0}, radius=0.05}
            :rotate{degrees=36 * n, center={x, 0, 0}}
    end
    temple[#temple + 1] = shaft - union(flutes)
    temple[#temple + 1] = box{min={x - 0.3, 2.88, -0.3}, max={x + 0.3, 3.02, 0.3}}
end
for n = 0, 2 do
    temple[#temple + 1] = box{min={-3 + 0.2 * n, 0.17 * n, -2 + 0.2 * n},
                              max={3 - 0.2 * n, 0.17 * n + 0.17, 0.95 - 0.2 * n}}
end
temple[#temple + 1] = box{min={-2.6, 3.02, -1.6}, max={2.6, 3.3, 0.4}}
add(union(temple):translate{0, 0, -2}:material(stone))
local gable = polyhedron{planes={{0, -1, 0, -3.3}, {0.45, 1, 0, 4.62}, {-0.45, 1, 0, 4.62},
                                 {0, 0, 1, 0.4}, {0, 0, -1, 1.6}}}
add((gable - cylinder{from={0, 3.85, 0.2}, to={0, 3.85, 0.6}, radius=0.42}):translate{0, 0, -2}
    :material{color={0.68, 0.3, 0.22}})
add(cylinder{from={0, 3.85, -1.82}, to={0, 3.85, -1.75}, radius=0.42}:material{unlit=true,
    texture=zoneplate{{0.95, 0.9, 0.7}, {0.25, 0.12, 0.3}, height=0.02, center={0, 3.85, 0}}})

-- ---- A fountain that is softer than the rest, in a bowl that is a quadric ----

local bowl = quadric{1, 0, 1, 0, 0, 0, 0, -0.8, 0, 0}:translate{0, 0.55, 0} *
             box{min={-1, 0.5, -1}, max={1, 1.05, 1}}
local hollow = quadric{1, 0, 1, 0, 0, 0, 0, -0.8, 0, 0}:translate{0, 0.65, 0}
add(((bowl - hollow) + cone{from={0, -0.1, 0}, to={0, 0.7, 0}, radii={0.3, 0.12}})
    :translate{0, 0, 3.6}:material(stone))
local drops = {}
for n = 0, 23 do
    local a, r = n * 2.4, 0.12 + 0.02 * n
    drops[#drops + 1] = ellipsoid{center={r * math.cos(a), 1.9 - 0.035 * n, r * math.sin(a)},
                                  radii={0.03, 0.06, 0.03}}
end
add(union(drops):spin{rpm=90}:translate{0, 0, 3.6}:temporal_width(1.5)
    :material{color={0.75, 0.85, 0.95}, specular=0.9})

-- ---- Chrome, glass and gold ----

add(sphere{center={4.3, 0.95, 1.2}, radius=0.95}:material(chrome))
add(sphere{center={2.9, 0.5, 3.1}, radius=0.5}:material{color={0.95, 1, 0.97}, refract=0.9,
    index=1.45, diffuse=0.05, ambient=0, specular=0.9, shininess=250, reflect=0.08})
local knot = {}
for n = 0, 2 do
    knot[#knot + 1] = torus{axis={0, 0, 1}, major=0.7, minor=0.14}:rotate{axis={0, 1, 0}, degrees=60 * n}
end
add(union(knot):spin{axis={0, 1, 0}, rpm=20}:translate{-4.3, 1.5, 1}:material(gold))
add((cylinder{from={-4.3, 0, 1}, to={-4.3, 0.55, 1}, radius=0.7} -
     torus{center={-4.3, 0.3, 1}, major=0.74, minor=0.12}):material(paint(0.5, 0.1, 0.12)))

-- ---- An aeroplane whose propeller has a shutter of its own ----

local metal = {color={0.8, 0.18, 0.12}, specular=0.5, shininess=70}
local plane = {ellipsoid{radii={0.95, 0.24, 0.24}}, ellipsoid{center={0.15, 0.05, 0}, radii={0.24, 0.03, 1.25}},
               ellipsoid{center={-0.8, 0.1, 0}, radii={0.13, 0.02, 0.42}},
               ellipsoid{center={-0.83, 0.26, 0}, radii={0.13, 0.24, 0.02}}}
local propeller = union(ellipsoid{center={1, 0, 0}, radii={0.03, 0.5, 0.07}},
                        sphere{center={0.98, 0, 0}, radius=0.09})
    :spin{axis={1, 0, 0}, rpm=1100}:temporal_width(0.1):material{color={0.15, 0.13, 0.1}}
add(union(union(plane):material(metal), propeller):rotate{axis={1, 0, 0}, degrees=-12}
    :translate{-7, 5.3, 0}:velocity{2.2, 0.05, 0})

-- ---- A painter's easel, and flags ----

add(box{min={-0.9, 0, -0.05}, max={0.9, 1.35, 0}}:rotate{axis={1, 0, 0}, degrees=-14}
    :translate{-5.9, 0.7, 3.2}:rotate{degrees=12, center={-5.9, 0, 3.2}}:material{ambient=0.2,
    texture=image{{0.3, 0.2, 0.1}, {0.3, 0.2, 0.1}, file="pictures/scenes/carousel.png",
                  corner={-0.8, 1.27, 0}, width=1.6}})
for side = -1, 1, 2 do
    add(cone{from={-5.9 + 0.9 * side, 0, 3.4}, to={-5.9 + 0.15 * side, 2.4, 2.7}, radii={0.05, 0.03}}
        :material(paint(0.4, 0.25, 0.12)))
end


for n = -1, 1, 2 do
    add(cylinder{from={5.2 * n, 0, -3}, to={5.2 * n, 4.6, -3}, radius=0.05}:material(gold))
    add(box{min={0, 0, -0.02}, max={1.5, 0.9, 0.02}}:translate{5.2 * n + 0.05, 3.6, -3}
        :material{texture=stripe{{0.9, 0.9, 0.9}, {0.1, 0.2, 0.55}, axis={0, 1, 0}, size=0.3}})
end
