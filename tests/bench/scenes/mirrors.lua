-- Mirror balls in a room of mirrors: what is seen may be anywhere, and small.
camera{eye={1.3, .9, 2.4}, look_at={0, -.1, 0}, fov=68}
light{point={0, 2.4, .5}}
light{point={2, 1.5, 2}, color={.3, .25, .2}}
local ball = {color={.06, .06, .08}, reflect=.85}
local walls = {color={.2, .22, .2}, reflect=.55, texture=checker{{.75, .25, .1}, {.1, .25, .5}, size=.6}}
add(difference(box{min={-3.2, -3.2, -3.2}, max={3.2, 3.2, 3.2}}, box{min={-3, -3, -3}, max={3, 3, 3}}:material(walls)))
for i = 0, 5 do
    add(sphere{center={1.5*math.cos(1.05*i), math.sin(2*i), 1.5*math.sin(1.05*i)}, radius=.5}:material(ball):spin{rpm=30})
end
duration(10)
