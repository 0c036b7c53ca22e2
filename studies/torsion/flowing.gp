# A rod that flows through its ends, with and without the momentum flux at the nodes.
width = 800; height = 500
load folder . "/../moving_string/style.gp"
set title "First torsional frequency of a rod that flows through its fixed ends at v = c/2"
set logscale x
set xlabel "elements N"
set ylabel "f_1 l/c"
set xrange [3.5:75]
set xtics (4, 8, 16, 32, 64)
set yrange [0.35:0.48]
set key center right
of(angles, formulation) = strcol("angles") eq angles && strcol("formulation") eq formulation && column("v_over_c") == 0.5 ? 1 : NaN
plot csv("flowing") using "elements":(of("linear", "variational") * column("frequency")) with linespoints linewidth 2 pointtype 7 linecolor rgb blue title "variational, with the flux", \
     csv("flowing") using "elements":(of("linear", "virtual-work") * column("frequency")) with linespoints linewidth 2 pointtype 5 linecolor rgb red title "virtual work, without", \
     csv("flowing") using "elements":(of("hermite", "virtual-work") * column("frequency")) with linespoints linewidth 2 pointtype 6 linecolor rgb green title "cubic angles, virtual work", \
     0.375 with lines dashtype 2 linecolor rgb grey title "exact: 0.375", \
     0.5/sqrt(1.25) with lines dashtype 3 linecolor rgb red title "exact without v^2 θ_{xx}: 0.4472"
