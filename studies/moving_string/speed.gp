# Frequencies against the speed, and growth beyond the critical one.
width = 1100; height = 480
load folder . "/style.gp"
set multiplot layout 1,2 title "Axially moving string and beam, F = 1000 N: linearised about the moving state"
of(model) = strcol("model") eq model ? 1 : NaN
coarse(model, n) = strcol("model") eq model && column("elements") == n && column("youngs_modulus") == 7e10 ? 1 : NaN
set xlabel "v (m/s)"
set ylabel "f (Hz)"
set xrange [0:90]
set yrange [0:120]
set key top right font ",12"
set title "(a) frequencies"
plot csv("speeds") using "speed":(of("string") * column("f1")) with lines linewidth 2 linecolor rgb red title "string, 8 elements: f_1, f_2", \
     csv("speeds") using "speed":(of("string") * column("f2")) with lines linewidth 2 linecolor rgb red, \
     csv("speeds") using "speed":(of("beam") * column("f1")) with lines linewidth 2 linecolor rgb blue title "beam, 8 elements: f_1, f_2", \
     csv("speeds") using "speed":(of("beam") * column("f2")) with lines linewidth 2 linecolor rgb blue, \
     csv("reference_speeds") using "speed":(coarse("string", 4) * column("f1_exact")) with points pointtype 6 linecolor rgb red title "exact", \
     csv("reference_speeds") using "speed":(coarse("string", 4) * column("f2_exact")) with points pointtype 6 linecolor rgb red, \
     csv("reference_speeds") using "speed":(coarse("beam", 4) * column("f1_exact")) with points pointtype 6 linecolor rgb blue title "exact", \
     csv("reference_speeds") using "speed":(coarse("beam", 4) * column("f2_exact")) with points pointtype 6 linecolor rgb blue
set title "(b) divergence: growth of a disturbance"
set ylabel "growth (1/s)"
set yrange [0:*]
set xrange [60:90]
set key top left
plot csv("speeds") using "speed":(of("string") * column("growth")) with lines linewidth 2 linecolor rgb red title "string", \
     csv("speeds") using "speed":(of("beam") * column("growth")) with lines linewidth 2 linecolor rgb blue title "beam"
unset multiplot
