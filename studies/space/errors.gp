# Error of a quarter arc against mesh and torsional stiffness; order in time; a shaft under torque, and one that is fed.
width = 1400; height = 900
load folder . "/style.gp"
set multiplot layout 2,3 title "Beams in space with frames" margins 0.07,0.97,0.09,0.90 spacing 0.08,0.15
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
unset logscale
set format "%g"
set xtics auto
set title "(d) first frequency [Hz] of a shaft under torque"
set xlabel "torque M L/EI"
set key bottom left notitle samplen 1.5
plot csv("twisted") using "torque":"exact" with lines linewidth 1.8 linecolor rgb "#888888" title "exact", \
     csv("twisted") using "torque":"frequency" with points pointtype 7 pointsize 0.7 linecolor rgb "#2171b5" title "12 elements"
set title "(e) torsion [mJ] of a shaft fed through clamps"
set xlabel "v/c"
set key top left notitle samplen 1.5
finest(n) = column("elements") == n ? 1e3*column("torsion") : NaN
set xrange [-0.02:0.52]
plot csv("fed") using "speed":(1e3*column("exact")) with lines linewidth 1.8 linecolor rgb "#888888" title "exact", \
     for [n in "8 16 32"] csv("fed") using "speed":(finest(n+0)) with points pointtype 7 pointsize 0.7 title n." elements"
set title "(f) error of the shaft at v = c/2"
set xlabel "elements"
set logscale xy
set format y "10^{%T}"
set xrange [6:40]
set xtics (8, 16, 32)
set key top right
plot csv("fed") using "elements":(column("speed") == 0.5 ? column("error") : NaN) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5" title "frames, fed", \
     2*x**(-2) with lines dashtype 2 linecolor rgb "#888888" title "order 2"
unset multiplot
