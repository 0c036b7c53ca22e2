# Time against the number of elements: (a) of an evaluation, an element; (b) of an event.
set terminal svg size 1000,460 font "sans-serif,14" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set datafile missing NaN
set border 3 linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set logscale x
set format x "10^{%T}"
set xlabel "elements"
set offsets graph 0.05, graph 0.05, 0, 0
csv = data . "time_by_elements.timing.csv"
of(n, name) = column("threads") == n ? column(name) : NaN
set multiplot layout 1,2
set title "(a) An evaluation, with tangents and solutions"
set ylabel "time an element [ns]"
set yrange [0:*]
set key top right noautotitle
plot csv using "elements":(of(1, "ns_an_evaluation_and_element")) with linespoints pointtype 7 linecolor rgb "#08519c" title "one thread", \
     csv using "elements":(of(2, "ns_an_evaluation_and_element")) with linespoints pointtype 5 linecolor rgb "#d94801" title "two threads"
set title "(b) An event: mesh, velocities, energies"
set ylabel "time [ms]"
set logscale y
set format y "10^{%T}"
set yrange [*:*]
set key top left
plot csv using "elements":(of(1, "event_ms")) with linespoints pointtype 7 linecolor rgb "#08519c" title "one thread", \
     csv using "elements":(of(2, "event_ms")) with linespoints pointtype 5 linecolor rgb "#d94801" title "two threads"
unset multiplot
