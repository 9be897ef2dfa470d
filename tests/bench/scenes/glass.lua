-- Glass balls and a glass box with a hole before a fine checker, one of them moving.
camera{eye={0, 1.8, 7}, look_at={0, .2, 0}, fov=36}
background{.4, .5, .65}
light{point={4, 8, 5}}
add(halfspace{normal={0, 1, 0}, offset=-.8}:material{texture=checker{{.85, .8, .6}, {.06, .05, .1}, size=.3}})
local glass = {color={.95, .97, 1}, diffuse=0, ambient=0, refract=.9, index=1.5, reflect=.08, specular=.6, shininess=150}
for i = -1, 1 do
    add(sphere{center={1.6*i, .1, 0}, radius=.7}:velocity{.4, 0, .3*i}:material(glass))
end
add(difference(box{min={-.5, -.8, 1.2}, max={.5, .1, 1.9}}, cylinder{from={0, -.7, 1.55}, to={0, .3, 1.55}, radius=.3})
    :spin{rpm=25, center={0, 0, 1.5}}:material(glass))
duration(10)
