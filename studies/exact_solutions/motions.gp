# Motions: mean of the errors over the scale of each, against what is refined.
width = 1300; height = 820
load folder . "/style.gp"
set multiplot layout 2,2 title "Motions against what is exact" margins 0.075,0.985,0.1,0.9 spacing 0.08,0.16
set key inside top right
set title "moving loads"
set xlabel "elements"
set xtics (8, 16, 32)
set xrange [7:200]
set yrange [1e-7:1e-3]
families = "'moving force' 'moving force' 'moving force' 'moving mass' 'moving mass' 'moving mass' 'rotating load' 'rotating load'"
cases = "'alpha = 0.25' 'alpha = 1' 'alpha = 2' 'm/(rhoA L) = 0.2 alpha = 0.25' 'm/(rhoA L) = 0.5 alpha = 0.5' 'm/(rhoA L) = 1.0 alpha = 1.0' 'a = 0.5 half a turn: resonance' 'a = 0.5 one turn r/l = 0.1 spin'"
titles = "'force, alpha = 0.25' 'force, alpha = 1' 'force, alpha = 2' 'mass 0.2, alpha = 0.25' 'mass 0.5, alpha = 0.5' 'mass 1, alpha = 1' 'turning load, resonance' 'turning load, gyroscopic'"
list = drawn(families, cases)
plot for [i in list] csv("errors") using "level":(of(word(families, i + 0), word(cases, i + 0), "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i + 0) title word(titles, i + 0), \
     4e-2 * x**(-8.0/3) with lines dashtype 2 linecolor rgb grey title "order 8/3"
set title "bead on a circular wire"
set xtics (4, 8, 16)
set xrange [3.5:50]
set yrange [1e-7:1e-1]
degrees = "'11.25 degrees' '22.5 degrees' '33.75 degrees' '45 degrees' '67.5 degrees'"
list = drawn("'circular wire' 'circular wire' 'circular wire' 'circular wire' 'circular wire'", degrees)
plot for [i in list] csv("errors") using "level":(of("circular wire", word(degrees, i + 0), "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i + 0) title "from " . word(degrees, i + 0), \
     1e-1 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4", \
     2e1 * x**-6 with lines dashtype 3 linecolor rgb grey title "order 6"
set xrange [1:1e10]
set yrange [1e-7:1]
set title "wires that are nearly rigid, ropes that are nearly without mass"
set xlabel "stiffness [N m^2], or m/mass"
set xtics auto
set format x "10^{%T}"
plot csv("errors") using "level":(of("straight wire", "30 degrees", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(1) title "straight wire", \
     csv("errors") using "level":(of("rotating wire", "vertical plane", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(2) title "rotating wire, vertical plane", \
     csv("errors") using "level":(of("rotating wire", "without gravity", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(3) title "rotating wire", \
     csv("errors") using "level":(of("capstan", "three guides", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(5) title "capstan, three guides", \
     1e0 / x with lines dashtype 2 linecolor rgb grey title "order 1"
set xrange [300:1e6]
set yrange [1e-6:1e-1]
set title "pendulums"
set xlabel "steps"
plot csv("errors") using "level":(of("elastic pendulum", "green", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(1) title "elastic, Green's law", \
     csv("errors") using "level":(of("elastic pendulum", "engineering", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(3) title "elastic, linear law", \
     csv("errors") using "level":(of("hoisted pendulum", "inextensible", "values")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(5) title "hoisted", \
     2e3 * x**-2 with lines dashtype 2 linecolor rgb grey title "order 2"
unset multiplot
