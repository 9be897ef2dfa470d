// tests/bench/many/mirrors.lua for POV-Ray 3.7.
#include "crowd.inc"
Look(<0, 5, 14>, <0, 0.5, 0>, 40)
box { <-7, -1, -6.2>, <7, 4, -6> texture { Paint(0.1, 0.1, 0.1, 0.8) } }
#for (X, -4, 4)
    #for (Z, -4, 4)
        sphere {
            <1.3 * X, -0.4 + 0.2 * mod(X + Z + 9, 3), 1.3 * Z>, 0.55
            texture { Paint(0.5 + X / 10, 0.5 + Z / 10, 0.5, 0.5) }
        }
    #end
#end
