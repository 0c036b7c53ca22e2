# Total error of the falling beam against `work`: each integrator on its best meshes. One colour a family of integrators.
set terminal svg size 900,560 font "sans-serif,14" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key outside right center noautotitle samplen 2
set logscale xy
set format xy "10^{%T}"
set xlabel work_title
set ylabel "total error at 0.5 s / L"
set title "Falling beam: each integrator on its best meshes, N = 4 to 60"
csv = data . table
plot for [i = 1:words(names)] csv using (strcol("integrator") eq word(names, i) ? column(work) : NaN):"total" \
       with linespoints linewidth 1.5 pointtype int(word(marks, i)) pointsize 0.8 \
       linecolor rgb word(colours, i) title word(names, i)
