# Drift of the total energy against time: the swing, and the falling beam between its events.
width = 1100; height = 560
load folder . "/../weights/style.gp"
array colours[7] = ["#0072b2", "#56b4e9", "#009e73", "#d55e00", "#e69f00", "#cc79a7", "#000000"]
set multiplot layout 1,2 title "Total energy without the jumps of length control: |E - E_0| over the largest kinetic energy" \
  margins 0.07,0.98,0.33,0.85 spacing 0.09
set logscale y
set format y "10^{%T}"
set xlabel "t (s)"
set yrange [1e-17:10]
set xrange [0:*]
of(name) = strcol("case") eq name ? 1 : NaN
swing = "dopri5_6 dopri5_9 fehlberg78_9 alpha_1 alpha_09 alpha_05 energy_momentum"
swing_title = "'dopri5, 1e-6' 'dopri5, 1e-9' 'fehlberg78, 1e-9' 'gen.-alpha(1)' 'gen.-alpha(0.9)' 'gen.-alpha(0.5)' 'energy-momentum'"
set key at screen 0.27,0.2 top center font ",12" maxrows 4
set title "(a) beam swinging from a pin, N = 10"
plot for [i=1:7] csv("history") using (of("swing_".word(swing, i)) * column("t")):(column("drift")) \
       with lines linewidth 1.6 linetype 1 linecolor rgb colours[i] title word(swing_title, i)
fall = "dopri5_9_virtual_work_nodal dopri5_9_variational_nodal alpha_09_variational_conservative energy_momentum_variational_conservative"
fall_title = "'virtual work, dopri5' 'variational, dopri5, 1e-9' 'variational, gen.-alpha(0.9)' 'variational, energy-momentum'"
set key at screen 0.77,0.2 top center
set title "(b) falling beam with a sliding mass, N = 20"
plot for [i=1:4] csv("history") using (of("falling_".word(fall, i)."_n20") * column("t")):(column("drift")) \
       with lines linewidth 1.6 linetype 1 linecolor rgb colours[int(word("7 2 5 4", i))] title word(fall_title, i)
unset multiplot
