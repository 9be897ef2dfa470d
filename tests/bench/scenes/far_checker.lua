-- A fine checker to the horizon under a camera that drives: near cells have one edge, far ones
-- hundreds.
camera{eye={0, 1, 0}, look_at={2, .5, -9}, fov=45}:velocity{1.5, 0, -4}
background{.35, .45, .6}
light{direction={-1, -2, -1}}
add(halfspace{normal={0, 1, 0}}:material{texture=checker{{.85, .85, .8}, {.04, .03, .03}, size=.2}})
duration(10)
