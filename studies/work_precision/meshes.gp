# Total error of the falling beam against time; the line is the Pareto front.
set terminal svg size 860,560 font "sans-serif,14" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key outside right center noautotitle
set logscale xy
set format xy "10^{%T}"
set xlabel "time [s]"
set ylabel "total error at 0.5 s / L"
set title "Falling beam: total error over meshes, elements and integrators"
csv = data . "total_error_times.timing.csv"
colour(n) = n <= 5 ? 0xc6dbef : n <= 8 ? 0x6baed6 : n <= 14 ? 0x2171b5 : n <= 28 ? 0xfd8d3c : 0xa63603
is(e, n) = strcol("element") eq e && strcol("integrator") eq n
array names[3] = ["dopri5", "fehlberg78", "generalized-alpha(0.6)"]
array marks[3] = [6, 10, 4]
plot data . "pareto_front.timing.csv" using "seconds":"total" with steps linewidth 1.5 linecolor rgb "#000000" title "Pareto front", \
     for [i = 1:3] csv using (is("ALE-RANCF", names[i]) ? column("seconds") : NaN):"total":(colour(column("elements"))) \
       with points pointtype marks[i] + 1 pointsize 0.9 linecolor rgb variable, \
     for [i = 1:3] csv using (is("ALE-ANCF", names[i]) ? column("seconds") : NaN):"total":(colour(column("elements"))) \
       with points pointtype marks[i] pointsize 0.9 linecolor rgb variable, \
     for [i = 1:3] keyentry with points pointtype marks[i] + 1 linecolor rgb "#444444" title names[i] . ", ALE-RANCF", \
     for [i = 1:3] keyentry with points pointtype marks[i] linecolor rgb "#444444" title names[i] . ", ALE-ANCF", \
     keyentry with points pointtype 5 linecolor rgb 0xc6dbef title "N = 4", \
     keyentry with points pointtype 5 linecolor rgb 0x6baed6 title "N = 6, 8", \
     keyentry with points pointtype 5 linecolor rgb 0x2171b5 title "N = 10, 14", \
     keyentry with points pointtype 5 linecolor rgb 0xfd8d3c title "N = 20, 28", \
     keyentry with points pointtype 5 linecolor rgb 0xa63603 title "N = 40, 60"
