# Frequencies against the speed, and growth beyond the critical one.
width = 1100; height = 480
load folder . "/style.gp"
set multiplot layout 1,2 title "Axially moving string and beam, F = 1000 N: linearised about the moving state"
of(model, n) = strcol("model") eq model && column("elements") == n ? 1 : NaN
soft(model) = strcol("model") eq model && column("elements") == 4 && column("youngs_modulus") == 7e10 ? 1 : NaN
set xlabel "v (m/s)"
set ylabel "f (Hz)"
set xrange [0:90]
set yrange [0:140]
set key top right font ",12"
set title "(a) first two frequencies"
plot for [f in "f1 f2"] csv("speeds") using "speed":(of("string", 8) * column(f)) with lines linewidth 2 linecolor rgb red title f eq "f1" ? "string, 8 elements" : "", \
     for [f in "f1 f2"] csv("reference_speeds") using "speed":(soft("string") * column(f."_exact")) with points pointtype 6 linecolor rgb red title f eq "f1" ? "exact" : "", \
     for [f in "f1 f2"] csv("speeds") using "speed":(of("beam", 8) * column(f)) with lines linewidth 2 linecolor rgb blue title f eq "f1" ? "beam, 8 elements" : "", \
     for [f in "f1 f2"] csv("reference_speeds") using "speed":(soft("beam") * column(f."_exact")) with points pointtype 6 linecolor rgb blue title f eq "f1" ? "exact" : ""
set title "(b) divergence of the beam"
set ylabel "growth of a disturbance (1/s)"
set yrange [-2:*]
set xrange [70:90]
set key top left
plot csv("speeds") using "speed":(of("beam", 8) * column("growth")) with lines linewidth 3 linecolor rgb light title "8 elements", \
     csv("speeds") using "speed":(of("beam", 16) * column("growth")) with lines linewidth 1.5 dashtype 2 linecolor rgb blue title "16 elements"
unset multiplot
