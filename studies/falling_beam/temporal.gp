# Temporal error against the integrator's tolerance.
width = 660; height = 480
load folder . "/style.gp"
set logscale xy
set format xy "10^{%T}"
set xrange [2e-4:5e-10] reverse
set xlabel "relative and absolute tolerance"
set ylabel "error at 0.5 s against the tightest tolerance / L"
set title "Temporal error, " . mesh
plot csv("temporal") using "tolerance":"error" with linespoints linewidth 2 pointtype 7 pointsize 0.8 linecolor rgb "#08519c"
