// tests/bench/many/dice.lua for POV-Ray 3.7.
#include "crowd.inc"
#include "transforms.inc"
Look(<0, 7, 14>, <0, 0, 0>, 40)
#declare Die = difference {
    intersection { box { -0.6, 0.6 } sphere { 0, 0.82 } }
    cylinder { -x, x, 0.35 }
    cylinder { -y, y, 0.35 }
    cylinder { -z, z, 0.35 }
};
#for (X, -4, 4)
    #for (Z, -4, 4)
        object {
            Die
            texture { Paint(0.5 + X / 10, 0.5 + Z / 10, 0.5, 0) }
            Axis_Rotate_Trans(<1, 1, 0>, (9 * X + Z) * 20)
            translate <1.5 * X, 0, 1.5 * Z>
        }
    #end
#end
