# Coulomb friction between mass and beam.
width = 1300; height = 500
load folder . "/style.gp"
set multiplot layout 1,3 title "Friction between mass and beam, μ = " . coefficient . ", ALE-ANCF, N = " . finest margins 0.07,0.985,0.14,0.82 spacing 0.085,0
histories = csv("friction")
set xlabel "t (s)"
set xrange [0:*]
set title "(a) position of the mass"
set ylabel "x_i (m)"
set key bottom right
plot for [m in modes] histories using "t":m."_joint" with lines linewidth mode_width(m) dashtype mode_dash(m) \
       linecolor rgb mode_colour(m) title mode_name(m)
set title "(b) dissipated energy"
set ylabel "energy (J)"
plot for [m in modes] histories using "t":m."_dissipated" with lines linewidth mode_width(m) dashtype mode_dash(m) \
       linecolor rgb mode_colour(m) title mode_name(m)
set title "(c) stretch before and behind the mass"
set ylabel "|r_x|"
set offsets 0, 0, graph 0.25, 0  # room for the key
set key top center vertical maxrows 2 width -8 samplen 1.2
plot histories using "t":"tangent_before" with lines linewidth 2 linecolor rgb "#08519c" title "tangent, before", \
     "" using "t":"tangent_behind" with lines linewidth 2 linecolor rgb "#6baed6" title "tangent, behind", \
     "" using "t":"free_before" with lines linewidth 2 linecolor rgb "#a63603" title "free, before", \
     "" using "t":"free_behind" with lines linewidth 2 linecolor rgb "#fd8d3c" title "free, behind"
unset multiplot
