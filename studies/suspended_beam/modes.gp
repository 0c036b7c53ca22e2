# What the beam's slopes do at the mass.
width = 1150; height = 900
load folder . "/style.gp"
set multiplot layout 2,2 title "Slopes at the mass: continuous, tangent, equal-stretch, free"
histories = csv("modes")
set xlabel "t (s)"
set xrange [0:*]
set title "(a) position of the mass, ALE-ANCF, N = " . finest
set ylabel "x_i (m)"
set key bottom right
plot for [m in modes] histories using "t":m."_joint" with lines linewidth mode_width(m) dashtype mode_dash(m) \
       linecolor rgb mode_colour(m) title mode_name(m)
set title "(b) kink at the mass, N = " . finest
set ylabel "angle from r_x^- to r_x^+ (degrees)"
unset key
plot for [m in modes] histories using "t":m."_kink" with lines linewidth mode_width(m) dashtype mode_dash(m) \
       linecolor rgb mode_colour(m)
set logscale xy
set xrange [2.5:30]
set xtics (3, 6, 12, 24)
set format y "10^{%T}"
set xlabel "elements N"
set title "(c) error of x_i over 1.2 s against N = " . reference . " of the same limit"
set ylabel "max |Δx_i| (m)"
set key bottom left Left reverse samplen 1
is(m, e) = strcol("slopes") eq mode_name(m) && strcol("element") eq e && column("elements") < real(reference) ? column("error") : NaN
plot for [m in modes] csv("modes_errors") using "elements":(is(m, "ALE-ANCF")) with points pointtype 7 pointsize 0.9 \
       linecolor rgb mode_colour(m), \
     for [m in modes] csv("modes_errors") using "elements":(is(m, "ALE-RANCF")) with points pointtype 8 pointsize 1.2 \
       linecolor rgb mode_colour(m), \
     NaN with points pointtype 7 linecolor rgb "#444444" title "ALE-ANCF", \
     NaN with points pointtype 8 pointsize 1.2 linecolor rgb "#444444" title "ALE-RANCF"
set title "(d) how far modes are apart, ALE-ANCF"
set ylabel "max |Δx_i| (m)"
set key bottom left Left reverse samplen 2
plot csv("modes_pairs") using "elements":"continuous_equal" with linespoints linewidth 2 pointtype 7 linecolor rgb "#444444" \
       title "continuous - equal-stretch", \
     "" using "elements":"continuous_tangent" with linespoints linewidth 2 pointtype 7 linecolor rgb "#08519c" \
       title "continuous - tangent", \
     "" using "elements":"equal_free" with linespoints linewidth 2 pointtype 7 linecolor rgb "#a63603" \
       title "equal-stretch - free"
unset multiplot
