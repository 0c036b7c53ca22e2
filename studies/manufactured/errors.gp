# Errors of the position against elements, by the speed of the mark and by the weights, and against steps.
width = 1300; height = 470
load folder . "/../exact_solutions/style.gp"
# those of the words that were run
present(names) = (some = "", sum [i=1:words(names)] (some = strstrt(run, "|" . word(names, i) . "|") > 0 ? some . " '" . word(names, i) . "'" : some, 0), some)
series(name, what) = strcol("series") eq name ? column(what) : NaN
set multiplot layout 1,3 title "Beams that are made to follow a chosen motion" margins 0.07,0.985,0.14,0.83 spacing 0.06,0.1
set key inside top right
set ylabel "error of the position (L2) [m sqrt(m)]"
set xlabel "elements"
set xrange [7:36]
set xtics (8, 16, 32)
set yrange [1e-7:10]
set title "(a) mark that travels"
nodes = "'nodes 0 m/s' 'nodes 1 m/s' 'nodes 10 m/s' 'joint 0 m/s' 'joint 1 m/s' 'joint 10 m/s'"
list = present(nodes)
plot for [i=1:words(list)] csv("errors") using "level":(series(word(list, i), "position")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(list, i), \
     2.5 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
set title "(b) strains, weights, shape at rest"
set yrange [1e-15:1]
set key inside bottom left
unset ylabel
kinds = "'sampled strain 0 m/s' 'sampled strain joint 10 m/s' 'smooth weights 0 m/s' 'smooth weights 10 m/s' 'curved at rest 10 m/s' 'uneven weights 0 m/s'"
list = present(kinds)
plot for [i=1:words(list)] csv("errors") using "level":(series(word(list, i), "position")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(list, i), \
     2.5 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
set title "(c) time, 64 elements"
set xlabel "steps of generalized-alpha"
set xrange [4:200]
set xtics (5, 10, 20, 40, 80, 160)
set yrange [1e-7:1e-1]
set key inside top right
list = present("'time nodes 10 m/s' 'time joint 10 m/s'")
plot for [i=1:words(list)] csv("errors") using "level":(series(word(list, i), "position")) with linespoints pointtype 7 pointsize 0.6 linecolor rgb colour(4 * i - 3) title word(list, i), \
     7.8e-2 * x**-2 with lines dashtype 2 linecolor rgb grey title "order 2"
unset multiplot
