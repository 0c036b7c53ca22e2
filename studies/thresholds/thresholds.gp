# Error, jumps of kinetic energy and number of events against the trigger, hysteresis 1e-3.
width = 1200; height = 800
load folder . "/../style.gp"
set multiplot layout 2,3 title "Length-control trigger, hysteresis 10^{-3}" margins 0.08,0.98,0.09,0.87 spacing 0.08,0.18
kinds = "ALE-RANCF ALE-ANCF"
colour(i) = i == 1 ? "#08519c" : "#a63603"
set xlabel "upper (L_{std})"
set xrange [1.45:2]
pick(beam, kind, value) = (strcol("beam") eq beam && strcol("element") eq kind && strcol("control") eq "on" && column("hysteresis") == 0.001) ? column(value) : NaN
do for [b=1:2] {
  beam = word("falling suspended", b)
  if (b == 1) { set key at screen 0.985,0.998 top right horizontal maxrows 1 } else { unset key }
  set title sprintf("(%s) %s beam: error at the end", word("a d", b), beam)
  set ylabel "error / L"
  set logscale y
  set format y "10^{%T}"
  plot for [i=1:2] csv("thresholds") using "upper":(pick(beam, word(kinds, i), "error")) with points pointsize 1.2 pointtype 5+2*i linecolor rgb colour(i) title word(kinds, i)
  unset key
  set title sprintf("(%s) %s beam: jumps of kinetic energy", word("b e", b), beam)
  set ylabel "sum of |ΔT| (J)"
  plot for [i=1:2] csv("thresholds") using "upper":(pick(beam, word(kinds, i), "kinetic_jumps")) with points pointsize 1.2 pointtype 5+2*i linecolor rgb colour(i)
  unset logscale y
  set format y "%g"
  set title sprintf("(%s) %s beam: events", word("c f", b), beam)
  set ylabel "events"
  set yrange [0:*]
set offsets 0,0,1,0
  plot for [i=1:2] csv("thresholds") using "upper":(pick(beam, word(kinds, i), "events")) with points pointsize 1.2 pointtype 5+2*i linecolor rgb colour(i)
  set offsets 0,0,0,0
  set autoscale y
}
unset multiplot
