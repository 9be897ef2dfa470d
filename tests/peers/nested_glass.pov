// Water in glass over a checkered floor, for POV-Ray 3.7: the peer of tests/campaign/glass.sh. The
// floor is the same in each direction of z but for the order of its colors.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 20 adc_bailout 0 }
background { rgb <0.1, 0.2, 0.3> }
camera {
    perspective location <0, 2, -9> look_at 0 right x * 4 / 3
    angle 2 * degrees(atan2(tan(radians(20)) * 4 / 3, 1))
}
#declare Clear = finish { ambient 0 diffuse 0 }
plane { y, -1.6 pigment { checker rgb 0.2 rgb 0.8 } finish { emission 1 diffuse 0 } }
sphere { 0, 1.5 pigment { rgbt 1 } finish { Clear } interior { ior 1.5 } }
sphere { 0, 1.2 pigment { rgbt 1 } finish { Clear } interior { ior 1.33 } }
