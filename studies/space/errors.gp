# Error of a quarter arc against mesh and torsional stiffness; critical loads against the mesh; order in time.
width = 1400; height = 500
load folder . "/style.gp"
set multiplot layout 1,3 title "Beams in space with frames" margins 0.07,0.97,0.14,0.84 spacing 0.08,0.1
set logscale xy
set format y "10^{%T}"
set title "(a) quarter arc, relative error of its end"
set xlabel "elements"
set xtics (2, 4, 8, 16, 32)
set key top right title "GIp/EI" samplen 1.5
arc(t, log10of) = abs(log10(column("torsion")) - log10of) < 0.05 ? column("error") : NaN
plot for [i=1:3] csv("arcs") using "elements":(arc(0, word("-3 -0.114 6", i)+0)) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb word("#2171b5 #31a354 #fd8d3c", i) title word("1e-3 1/1.3 1e6", i), \
     0.5*x**(-4) with lines dashtype 2 linecolor rgb "#888888" title "order 4"
set title "(b) the same, N = 8"
set xlabel "GIp/EI"
set xtics auto
set format x "10^{%T}"
unset key
plot csv("arcs") using "torsion":(column("elements") == 8 ? column("error") : NaN) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5"
set title "(c) a driven free arc, error [m] of its end"
set xlabel "step [s]"
set key bottom right notitle samplen 1.5
plot csv("steps") using "step":"error" with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5" title "generalized-alpha", \
     30*x**2 with lines dashtype 2 linecolor rgb "#888888" title "order 2"
unset multiplot
