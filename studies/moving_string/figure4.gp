# Figure 4 of the paper: the axially moving beam.
width = 900; height = 430
load folder . "/style.gp"
of(model, spin) = strcol("model") eq model && strcol("spin") eq spin ? 1 : NaN
set title "Figure 4: midpoint of the axially moving beam, 4 elements"
set xlabel "t (s)"
set ylabel "deflection (mm)"
set key top right
set yrange [-0.03:0.04]
plot csv("history") using "t":(of("beam", "yes") * column("deflection") * 1e3) with lines linewidth 2.2 linecolor rgb light title "with angles (VLBSE)", \
     csv("history") using "t":(of("beam", "no") * column("deflection") * 1e3) every 4 with points pointtype 6 pointsize 0.5 linecolor rgb red title "without (VLBE)"
