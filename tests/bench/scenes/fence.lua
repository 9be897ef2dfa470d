-- Bars thinner than a pixel, their shadows on the ground, and a ball that rolls behind them.
camera{eye={0, 2, 11}, look_at={0, .6, 0}, fov=38}
background{.5, .6, .75}
light{point={5, 9, 6}}
add(halfspace{normal={0, 1, 0}}:material{color={.35, .4, .25}})
for i = -24, 24 do
    add(cylinder{from={i/5, 0, .1*i}, to={i/5, 1.8, .1*i}, radius=.012}:material{color={.9, .9, .85}})
end
add(sphere{center={-1, .7, -2}, radius=.7}:velocity{2, 0, 0}:material{color={.7, .1, .1}, specular=.5})
duration(10)
