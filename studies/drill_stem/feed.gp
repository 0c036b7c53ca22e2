# The bit of a stem that is fed while it spins. `turns` [1/s] of the table; `coarsest` and `finest` element counts.
width = 1100; height = 420
load folder . "/../moving_string/style.gp"
n_low = int(coarsest); n_high = int(finest); spin = real(turns)
set multiplot layout 1,3 title sprintf("Drill stem fed through its guide, %.0f turns a second", spin)
of(n) = column("elements") == n ? 1 : NaN
set xlabel "overhang (m)"
set xtics 0.1
set key bottom right
set title "(a) whirl of the bit"
set ylabel "distance from the axis (mm)"
plot csv("feed") using "overhang":(of(n_low) * column("whirl") * 1e3) with lines linewidth 3 linecolor rgb light title sprintf("%d elements", n_low), \
     csv("feed") using "overhang":(of(n_high) * column("whirl") * 1e3) with lines linewidth 1 linecolor rgb blue title sprintf("%d elements", n_high)
set title "(b) lowest frequency of the overhang"
set ylabel "f (Hz)"
set key top right
set yrange [0:*]
plot csv("feed") using "overhang":(of(n_high) * column("frequency")) with lines linewidth 2 linecolor rgb blue title "bending", \
     spin with lines dashtype 2 linecolor rgb red title "spin"
set title "(c) lag of the bit"
set ylabel "θ_0 - θ_N (rad)"
set key bottom right
plot csv("feed") using "overhang":(of(n_high) * column("twist")) with lines linewidth 2 linecolor rgb blue
unset multiplot
