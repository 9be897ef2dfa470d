-- One small picture for each feature of the scene language: README.md shows them, and
-- pictures.sh makes them.
--
--   weft render gallery.lua --set show=torus --raster 160x120@30p,par=1:1 --frames 0 -o torus.png

duration(1)
background{0.5, 0.58, 0.68}

local red = {color={0.75, 0.16, 0.1}, specular=0.3}
local blue = {color={0.15, 0.3, 0.65}, specular=0.3}
local clay = {color={0.72, 0.6, 0.45}, specular=0.2}
local function floor(look)
    add(halfspace{normal={0, 1, 0}}:material(look or {color={0.5, 0.5, 0.48}}))
end
local function view()
    camera{eye={2.2, 2.4, 4.6}, look_at={0, 0.85, 0}, fov=34}
    light{point={5, 9, 6}, color={1, 0.97, 0.92}}
end
local function a() return box{min={-0.8, 0, -0.8}, max={0.8, 1.6, 0.8}}:material(red) end
local function b() return sphere{center={0.35, 1.2, 0.35}, radius=0.85}:material(blue) end
local function ball() return sphere{center={0, 0.8, 0}, radius=0.8} end
local function lit(solid) view() floor() add(solid) end
local function dim() camera{eye={2.2, 2.4, 4.6}, look_at={0, 0.85, 0}, fov=34} floor() end

local features = {
    sphere = function() lit(ball():material(clay)) end,
    ellipsoid = function()
        lit(ellipsoid{center={0, 0.7, 0}, radii={1.2, 0.7, 0.5}}:material(clay))
    end,
    box = function() lit(box{min={-0.9, 0, -0.6}, max={0.9, 1.2, 0.6}}:material(clay)) end,
    cylinder = function()
        lit(cylinder{from={-0.8, 0.5, 0}, to={0.8, 1.1, 0}, radius=0.5}:material(clay))
    end,
    cone = function()
        lit(cone{from={0, 0, 0}, to={0, 1.7, 0}, radii={0.9, 0.3}}:material(clay))
    end,
    torus = function()
        lit(torus{center={0, 0.9, 0}, axis={0.3, 1, 0.5}, major=0.8, minor=0.3}:material(clay))
    end,
    halfspace = function()
        lit((halfspace{normal={1, 1, 0.5}, offset=0.7} * box{min={-1, 0, -1}, max={1, 1.5, 1}})
            :material(clay))
    end,
    quadric = function()
        lit((quadric{1, -0.6, 1, 0, 0, 0, 0, 0, 0, -0.15}:translate{0, 0.9, 0} *
             box{min={-2, 0, -2}, max={2, 1.8, 2}}):material(clay))
    end,
    polyhedron = function()
        local planes = {}
        for _, s in ipairs{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1},
                           {-1, -1, 1}, {-1, -1, -1}} do
            planes[#planes + 1] = {s[1], s[2], s[3], 0.95}
        end
        lit(polyhedron{planes=planes}:translate{0, 0.95, 0}:material(clay))
    end,

    union = function() lit(union(a(), b())) end,
    intersection = function() lit(intersection(a(), b())) end,
    difference = function() lit(difference(a(), b())) end,

    translate = function() lit(union(a():scale(0.5), a():scale(0.5):translate{1.2, 0, -0.6})) end,
    rotate = function() lit(a():rotate{axis={0, 1, 0}, degrees=40}) end,
    scale = function() lit(a():scale{1.4, 0.6, 0.8}) end,
    velocity = function() lit(ball():material(red):translate{-0.4, 0, 0}:velocity{30, 0, 0}) end,
    spin = function() lit(a():scale{1, 0.5, 0.4}:spin{axis={0, 1, 0}, rpm=200}) end,
    keyframes = function()
        lit(a():scale{0.5, 1, 0.5}:keyframes{{time=0, translate={-0.9, 0, 0}},
            {time=0.033, translate={0.9, 0, 0}, axis={0, 0, 1}, degrees=-50}})
    end,
    temporal_width = function()
        local thrown = sphere{radius=0.55}:velocity{0, 0, 40}
        view() floor()
        add(thrown:translate{-0.7, 0.7, -0.6}:material(red))
        add(thrown:translate{0.9, 0.7, -0.6}:temporal_width(0.1):material(blue))
    end,

    checker = function()
        lit(ball():material{texture=checker{{0.8, 0.75, 0.6}, {0.3, 0.15, 0.1}, size=0.3}})
    end,
    stripe = function()
        lit(ball():material{texture=stripe{{0.85, 0.85, 0.8}, {0.1, 0.2, 0.5}, axis={0.4, 1, 0},
                                         size=0.16}})
    end,
    zoneplate = function()
        lit(box{min={-1.1, 0, -0.1}, max={1.1, 1.8, 0}}:material{
            texture=zoneplate{{1, 0.95, 0.85}, {0.1, 0.1, 0.2}, height=0.06, center={0, 0.9, 0}}})
    end,
    image = function()
        lit(box{min={-1.2, 0.05, -0.1}, max={1.2, 1.85, 0}}:material{
            texture=image{file="pictures/scenes/carousel.png", corner={-1.2, 1.85, 0}, width=2.4}})
    end,
    ambient = function() dim() add(ball():material{color={0.75, 0.16, 0.1}, ambient=0.5}) end,
    specular = function()
        lit(ball():material{color={0.3, 0.1, 0.08}, specular=1, shininess=120})
    end,
    reflect = function()
        view() floor{texture=checker{{0.7, 0.7, 0.65}, {0.25, 0.25, 0.3}, size=0.5}}
        add(ball():material{color=0.05, reflect=0.8, specular=0.8, shininess=200})
    end,
    refract = function()
        view() floor{texture=checker{{0.7, 0.7, 0.65}, {0.25, 0.25, 0.3}, size=0.5}}
        add(ball():material{color={0.95, 1, 0.97}, refract=0.95, index=1.4, diffuse=0, ambient=0,
                          specular=0.8, shininess=200})
    end,
    unlit = function() view() floor() add(ball():material{color={0.75, 0.16, 0.1}, unlit=true}) end,

    point = function() dim() add(ball():material(clay)) light{point={-2, 2.5, 1.5}} end,
    direction = function() dim() add(ball():material(clay)) light{direction={1, -1, -0.6}} end,
    spot = function()
        dim() add(ball():material(clay))
        light{point={2, 5, 2}, look_at={0, 0.4, 0}, inner=16, outer=26}
    end,
    perspective = function()
        camera{eye={0.6, 1.2, 3.2}, look_at={0, 0.7, 0}, fov=60}
        light{point={5, 9, 6}} floor()
        for z = -6, 1 do add(box{min={-0.9, 0, z}, max={-0.4, 1, z + 0.5}}:material(red)) end
    end,
    orthographic = function()
        camera{eye={3, 3, 5}, look_at={0, 0.4, -2}, ortho_height=4}
        light{point={5, 9, 6}} floor()
        for z = -6, 1 do add(box{min={-0.9, 0, z}, max={-0.4, 1, z + 0.5}}:material(red)) end
    end,
}

local feature = features[param.show or "difference"]
if not feature then error("there is no feature '" .. tostring(param.show) .. "'") end
feature()
