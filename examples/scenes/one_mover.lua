-- The still life of still.lua, and one ball that rolls over the table: it covers a twentieth of
-- the picture, and only what it passes is looked at through time.
--
--   weft render one_mover.lua --temporal-width 1 -o mover.y4m

include "still.lua"
add(sphere{radius=0.34}:material{texture=stripe{{0.9, 0.9, 0.9}, {0.1, 0.1, 0.4}, axis={0, 1, 0},
                                                size=0.17}}
    :spin{axis={0, 0, 1}, rpm=-40}:translate{-2.8, 1.29, 1.15}:velocity{1.42, 0, 0})
