# Energy between length-control events.
width = 800; height = 560
load folder . "/style.gp"
set title "Energy that no event accounts for, ALE-ANCF, N = " . elements
set logscale y
set format y "10^{%T}"
set yrange [1e-13:10]
set xlabel "t (s)"
set ylabel "|E - E_0 - jumps| / largest kinetic energy"
set key outside right top
plot for [m in modes] csv("ledger") using "t":"virtual_".m with lines linewidth 2 linecolor rgb mode_colour(m) \
       title "virtual work, " . mode_name(m), \
     for [m in modes] csv("ledger") using "t":"variational_".m with lines linewidth 2 dashtype 2 \
       linecolor rgb mode_colour(m) title "variational, " . mode_name(m)
