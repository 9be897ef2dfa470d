// examples/scenes/carousel.lua for POV-Ray 3.7, solid by solid: the peer of the tracer's bench.
// Its handedness is the camera's: with right and up as here the numbers are the same. The clock is
// in seconds.
//
//   povray +Icarousel.pov +W720 +H486 +AM1 +A0.0 +R8 -J +K0 +WT2 Declare=Rpm=10

#version 3.7;
#ifndef (Rpm) #declare Rpm = 10; #end

global_settings { assumed_gamma 1.0 max_trace_level 5 }
background { rgb <0.25, 0.42, 0.72> }

#declare Eye = <0, 5.2, 13.5>;
#declare Aim = <0, 1.75, 0>;
#declare Forward = vnormalize(Aim - Eye);
#declare Right = vnormalize(vcross(Forward, y));
#declare Up = vcross(Right, Forward);
#declare Height = 2 * tan(radians(33 / 2));
#ifndef (Lines) #declare Lines = 0; #end // how many of 486 the picture is shifted up
camera {
    perspective location Eye direction Forward + Up * Height * Lines / 486
    right Right * Height * (720 * 10 / 11) / 486 up Up * Height
}
light_source { <9, 17, 11> color rgb <1.0, 0.94, 0.84> }

#macro Paint(R, G, B)
    pigment { rgb <R, G, B> }
    finish { ambient 0.1 diffuse 0.9 specular 0.25 roughness 1 / 60 }
#end
#declare Brass = texture { pigment { rgb <0.86, 0.62, 0.22> }
                           finish { ambient 0.14 diffuse 0.9 specular 0.7 roughness 1 / 90 } }
#declare Cream = texture { Paint(0.9, 0.84, 0.7) }
#declare Skin = texture { Paint(0.78, 0.53, 0.38) }
#declare Shoe = texture { Paint(0.06, 0.05, 0.05) }

#macro Limb(A, B, R0, R1) cone { A, R0, B, R1 } #end

#macro Figure(Shirt, Cloth)
    union {
        sphere { <0, 1.62, 0>, 0.155 texture { Skin } }
        torus { 0.16, 0.035 translate 1.7 * y texture { Shirt } }
        cone { <0, 1.69, 0>, 0.15, <0, 1.93, 0>, 0.11 texture { Shirt } }
        cylinder { <0, 1.4, 0>, <0, 1.55, 0>, 0.06 texture { Skin } }
        sphere { 0, 1 scale <0.24, 0.32, 0.15> translate 1.17 * y texture { Shirt } }
        sphere { 0, 1 scale <0.2, 0.16, 0.15> translate 0.84 * y texture { Cloth } }
        cylinder { <0, 0.84, 0>, <0, 0.9, 0>, 0.2 scale <1, 1, 0.75> texture { Brass } }
        #local Side = -1;
        #while (Side <= 1)
            #local Shoulder = <0.23 * Side, 1.33, 0>;
            #local Hand = <0.68 * Side, 1.16, 0.12>;
            #local Elbow = <0.47 * Side, 1.17, -0.03>;
            #local Hip = <0.1 * Side, 0.8, 0>;
            #local Knee = <0.13 * Side, 0.43, 0.06 * Side>;
            #local Foot = <0.14 * Side, 0.04, 0>;
            union { Limb(Shoulder, Elbow, 0.085, 0.065) sphere { Shoulder, 0.088 }
                    sphere { Elbow, 0.066 } texture { Shirt } }
            union { Limb(Elbow, Hand, 0.06, 0.045) sphere { Hand, 0.065 } texture { Skin } }
            union { Limb(Hip, Knee, 0.11, 0.08) Limb(Knee, Foot, 0.078, 0.055)
                    sphere { Knee, 0.08 } texture { Cloth } }
            intersection {
                sphere { 0, 1 scale <0.075, 0.06, 0.15> translate <0.14 * Side, 0.05, 0.06> }
                plane { -y, 0 }
                texture { Shoe }
            }
            #local Side = Side + 2;
        #end
    }
#end

#declare Roof = difference {
    cone { <0, 4, 0>, 4.5, <0, 5.2, 0>, 0.15 }
    cone { <0, 3.9, 0>, 4.4, <0, 5.0, 0>, 0.05 }
}

#declare Shirts = array[6];
#declare Trousers = array[6];
#declare Shirts[0] = texture { Paint(0.75, 0.1, 0.08) }
#declare Trousers[0] = texture { Paint(0.1, 0.12, 0.3) }
#declare Shirts[1] = texture { Paint(0.08, 0.4, 0.2) }
#declare Trousers[1] = texture { Paint(0.35, 0.28, 0.2) }
#declare Shirts[2] = texture { Paint(0.1, 0.25, 0.65) }
#declare Trousers[2] = texture { Paint(0.75, 0.72, 0.66) }
#declare Shirts[3] = texture { Paint(0.85, 0.6, 0.08) }
#declare Trousers[3] = texture { Paint(0.16, 0.1, 0.1) }
#declare Shirts[4] = texture { Paint(0.5, 0.12, 0.5) }
#declare Trousers[4] = texture { Paint(0.2, 0.25, 0.22) }
#declare Shirts[5] = texture { Paint(0.85, 0.85, 0.82) }
#declare Trousers[5] = texture { Paint(0.55, 0.1, 0.1) }

union {
    difference {
        cylinder { <0, 0.35, 0>, <0, 0.6, 0>, 4.3 }
        cylinder { <0, 0.5, 0>, <0, 0.7, 0>, 1.2 }
        texture {
            pigment { gradient x
                      color_map { [0.5 rgb <0.5, 0.28, 0.14>] [0.5 rgb <0.4, 0.21, 0.1>] }
                      scale 0.8 }
            finish { ambient 0.1 diffuse 0.9 specular 0.2 roughness 1 / 40 }
        }
    }
    torus { 4.3, 0.1 translate 0.48 * y texture { Brass } }
    cylinder { <0, 0.12, 0>, <0, 0.35, 0>, 4.55 texture { Paint(0.55, 0.1, 0.1) } }
    cylinder { <0, 0.5, 0>, <0, 4.1, 0>, 0.34 texture { Cream } }
    #declare N = 0;
    #while (N < 3)
        torus { 0.36, 0.07 translate (1.2 + N) * y texture { Brass } }
        #declare N = N + 1;
    #end
    #declare N = 0;
    #while (N < 12)
        intersection {
            object { Roof }
            plane { -z, 0 rotate (30 * N) * y }
            plane { <-sin(pi / 6), 0, cos(pi / 6)>, 0 rotate (30 * N) * y }
            #if (mod(N, 2) = 0) texture { Paint(0.72, 0.08, 0.07) } #else texture { Cream } #end
        }
        sphere { <4.42, 3.94, 0>, 0.11 texture { Brass } rotate (30 * N) * y }
        #declare N = N + 1;
    #end
    sphere { <0, 5.3, 0>, 0.22 texture { Brass } }
    #declare N = 0;
    #while (N < 6)
        object { Figure(Shirts[N], Trousers[N]) translate <0, 0.6, 3.35>
                 rotate (60 * N + 12) * y }
        cylinder { <0, 0.6, 2.6>, <0, 4.1, 2.6>, 0.05 texture { Brass } rotate (60 * N + 12) * y }
        #declare N = N + 1;
    #end
    rotate (6 * Rpm * clock) * y
}

plane {
    y, 0
    texture {
        pigment { checker rgb <0.62, 0.66, 0.5> rgb <0.2, 0.36, 0.16> scale 1.5
                  translate -0.0001 * y }
        finish { ambient 0.1 diffuse 0.85 }
    }
}
