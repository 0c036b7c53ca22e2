# Temporal error of one problem against `work`: evaluations or seconds. One colour a family of integrators.
set terminal svg size 1100,560 font "sans-serif,14" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
timed = work eq "seconds"
csv = data . (timed ? "times.timing.csv" : "evaluations.csv")
ylabel_text = "max(|Δx_i|, |Δ{/:Bold r}_{end}|, |Δ{/:Bold r}_{mass}|) / L at the end"
set xlabel timed ? "time [s]" : "evaluations of the equations"
# The key has the methods that this problem has a point of, in either panel.
drawn = ""
do for [i = 1:words(names)] {
  undefine STATS_*
  stats csv using (strcol("problem") eq problem && strcol("integrator") eq word(names, i) && \
                   (strcol("ending") eq "completed" || (timed && strcol("ending") eq "capped")) ? 1 : NaN) nooutput
  drawn = drawn . (exists("STATS_records") && STATS_records > 0 ? " 1" : " 0")
}
panels = words(elements)
set multiplot layout 1,panels title title_text margins 0.08,0.74,0.12,0.84 spacing 0.08
is(e, n) = strcol("problem") eq problem && strcol("element") eq e && strcol("integrator") eq n
ended(e, n, what) = is(e, n) && strcol("ending") eq what
spread(error, i) = error == 1 ? 0.6 ** i : error  # capped from the first rung on: no error to show, but apart
titled(i) = word(drawn, i) eq "1" ? word(names, i) : ""
set logscale xy
set format xy "10^{%T}"
set yrange [*:3]
if (timed) { set xrange [2e-3:real(cap) * 1.5] }
do for [p = 1:panels] {
  e = word(elements, p)
  set title e
  set ylabel p == 1 ? ylabel_text : ""
  if (p == panels) { set key at screen 0.995,0.5 right center noautotitle samplen 2 } else { set key off }
  if (timed) {
    set arrow 1 from first real(cap),graph 0 to first real(cap),graph 1 nohead dashtype 3 linecolor rgb "#888888"
    plot for [i = 1:words(names)] csv using (ended(e, word(names, i), "capped") ? real(cap) : is(e, word(names, i)) ? column("seconds") : NaN): \
           (ended(e, word(names, i), "completed") ? column("error") : ended(e, word(names, i), "capped") && column("shown_at") < 1 ? column("shown_at") : NaN) \
           with lines linewidth 1.5 linecolor rgb word(colours, i), \
         for [i = 1:words(names)] csv using (ended(e, word(names, i), "completed") ? column("seconds") : NaN):"error" \
           with points pointtype int(word(marks, i)) pointsize 0.8 linecolor rgb word(colours, i) title titled(i), \
         for [i = 1:words(names)] csv using (ended(e, word(names, i), "capped") ? real(cap) : NaN):(spread(column("shown_at"), i)) \
           with points pointtype int(word(marks, i)) - 1 pointsize 1.1 linecolor rgb word(colours, i)
  } else {
    plot for [i = 1:words(names)] csv using (ended(e, word(names, i), "completed") ? column("evaluations") : NaN):"error" \
           with linespoints linewidth 1.5 pointtype int(word(marks, i)) pointsize 0.8 \
           linecolor rgb word(colours, i) title titled(i)
  }
}
unset multiplot
