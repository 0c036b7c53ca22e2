# Equilibria: norms of what the axis is off; frequencies: mean of their errors.
width = 1500; height = 520
load folder . "/style.gp"
families = "'roll-up' 'soft roll-up' 'elastica' 'extensible elastica' 'arm scale' 'rod in a sleeve' 'catenary' 'sliding weight'"
cases = "'green 1 turn' 'green 1 turn' 'P L^2/EI = 10' 'green P L^2/EI = 4' '1.3 N and 1 N' '60 degrees' 'green rise 0.3' 'green'"
set xlabel "elements"
set xtics (8, 16, 32, 64, 128, 256)
set multiplot layout 1,3 title "Equilibria and frequencies against what is exact" margins 0.075,0.765,0.13,0.85 spacing 0.07,0.1
unset key
set xrange [7:300]
set title "displacement, L2, over the length"
list = drawn(families, cases)
plot for [i in list] csv("errors") using "level":(of(word(families, i + 0), word(cases, i + 0), "L2")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i + 0) title word(families, i + 0), \
     5e-1 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
set xrange [7:300]
set key at screen 0.995,0.93 top right samplen 1.5 title "displacement and slope"
set title "slope, seminorm of H1"
list = drawn(families, cases)
plot for [i in list] csv("errors") using "level":(of(word(families, i + 0), word(cases, i + 0), "H1")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i + 0) title word(families, i + 0), \
     2e-1 * x**-3 with lines dashtype 2 linecolor rgb grey title "order 3"
set xrange [3.5:90]
set title "frequencies and weights, over the largest"
names = "'hanging chain' \"Beck's column\" \"Beck's column\" 'moving string' 'moving beam' 'moving beam' 'torsion' 'three weights'"
whichs = "'1 kg at its end' 'p = 20' 'critical load' 'v = 0.6 c' 'k = 0.1 v = 1.02 c' 'k = 0.5 v = 0.6 c' 'fixed-fixed cubic angles' '1 1.2 and 1 N'"
titles = "'hanging chain with a weight' \"Beck's column, p = 20\" \"Beck's column, critical load\" 'moving string' 'moving beam, k = 0.1' 'moving beam, k = 0.5' 'torsion, cubic angles' 'three weights'"
set xtics (4, 8, 16, 32, 80)
set key noopaque at screen 0.995,0.48 top right samplen 1.5 title "frequencies and weights"
list = drawn(names, whichs)
plot for [i in list] csv("errors") using "level":(of(word(names, i + 0), word(whichs, i + 0), "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i + 0) title word(titles, i + 0), \
     2e0 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
unset multiplot
