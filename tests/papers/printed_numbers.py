# SPDX-License-Identifier: BSD-3-Clause
"""Every number that the source prints of its runs in the sections of the registry, in their order on its pages: what is printed
of it must stand in the claims named. Made by hand, and held against all numerals of these sections: left out are those of
figures, equations and references, of the computers and the battery, and the levels of noise, which the claims of 7.18 name in
what they are about."""

PRINTED = {
    "2.1": [("2.1/length", "0.32"), ("2.1/mass", "0.8"), ("2.1/chamber", "9"), ("2.1/forward", "0.13"), ("2.1/turning", "30.6"),
            ("2.1/dive", "5"), ("2.1/rise", "10")],
    "2.3.2": [("2.3.2/gas-rate", "1"), ("2.3.2/saturation", "1e-7")],
    "2.4": [
        ("2.4/start", "0"), ("2.4/speed", "5.4"), ("2.4/azimuth", "-38.35"), ("2.4/elevation", "15.8"), ("2.4/one-x", "4"),
        ("2.4/one-y", "20"), ("2.4/one-z", "-50"), ("2.4/one-speed", "5.1"), ("2.4/one-azimuth", "-84.29"),
        ("2.4/one-elevation", "11.25"), ("2.4/y-0", "0.92"), ("2.4/outside", "will not pass"), ("2.4/y-reached", "11.36"),
        ("2.4/passes-one", "25.66"), ("2.4/two-x", "-6"), ("2.4/two-y", "30"), ("2.4/two-z", "50"), ("2.4/two-speed", "4.1"),
        ("2.4/two-azimuth", "123.69"), ("2.4/two-elevation", "29.02"), ("2.4/y-two", "7.67"), ("2.4/y-two-reached", "54.2"),
        ("2.4/passes-two", "55.6")],
    "3.4.1": [
        ("3.4.1/lane", "4"), ("3.4.1/UAS-start", "(0, 0, 150)"), ("3.4.1/B-start", "(50, -30)"), ("3.4.1/UAS-speed", "31.31"),
        ("3.4.1/B-speed", "22.22"), ("3.4.1/UAS-heading", "0"), ("3.4.1/B-heading", "0"), ("3.4.1/duration", "149"),
        ("3.4.1/tracked", "successfully"), ("3.4.1/tracked-by-ours", "successfully"), ("3.4.1/veer", "veer away"),
        ("3.4.1/UAS-mph", "70"), ("3.4.1/B-mph", "50")],
    "3.4.2": [
        ("3.4.2/period", "360"), ("3.4.2/UAS-start", "(0, 0, 350)"), ("3.4.2/UAS-speed", "31.31"), ("3.4.2/B-start", "(0, -20)"),
        ("3.4.2/UAS-heading", "0"), ("3.4.2/B-heading", "0"), ("3.4.2/slow", "14.79"), ("3.4.2/fast", "22.63"),
        ("3.4.2/duration", "671"), ("3.4.2/UAS-mph", "70"), ("3.4.2/slow-mph", "33.08"), ("3.4.2/fast-mph", "50.62"),
        ("3.4.2/chase", "successfully")],
    "4.2.1": [("4.2.1/finite", "finite time")],
    "4.3": [("4.3/field-of-view", "field of view"), ("4.3/sensor-width", "5")],
    "4.3.0.1": [
        ("4.3.0.1/UAS-start", "(0, 0, 425)"), ("4.3.0.1/B1-start", "(100, -150)"), ("4.3.0.1/B2-start", "(100, -120)"),
        ("4.3.0.1/B3-start", "(90, -135)"), ("4.3.0.1/UAS-speed", "31.31"), ("4.3.0.1/UAS-heading", "0"),
        ("4.3.0.1/speeds", "(22.22, 22.22, 22.22)"), ("4.3.0.1/headings", "(0, 0, 0)"), ("4.3.0.1/duration", "150"),
        ("4.3.0.1/UAS-mph", "70"), ("4.3.0.1/speeds-mph", "50")],
    "4.3.0.2": [
        ("4.3.0.2/period", "360"), ("4.3.0.2/UAS-start", "(0, 0, 450)"), ("4.3.0.2/UAS-speed", "31.31"),
        ("4.3.0.2/B1-start", "(100, -160)"), ("4.3.0.2/B2-start", "(100, -130)"), ("4.3.0.2/B3-start", "(90, -145)"),
        ("4.3.0.2/UAS-heading", "0"), ("4.3.0.2/headings", "(0, 0, 0)"), ("4.3.0.2/slow", "14.79"), ("4.3.0.2/fast", "22.63"),
        ("4.3.0.2/duration", "390"), ("4.3.0.2/UAS-mph", "70"), ("4.3.0.2/slow-mph", "33.08"), ("4.3.0.2/fast-mph", "50.62")],
    "4.3.1": [
        ("4.3.1/total", "46.72"), ("4.3.1/rate", "21.4"), ("4.3.1/tracker", "35.7"), ("4.3.1/controller", "0.62"),
        ("4.3.1/ellipse", "2.35"), ("4.3.1/filter", "8.04"), ("4.3.1/bottleneck", "3"), ("4.3.1/picture", "1000 x 800"), ("4.3.1/others", "33.33"), ("4.3.1/samples", "15000"),
        ("4.3.1/median-tracker", "34.58"), ("4.3.1/median-total", "45.63"), ("4.3.1/ellipse-complexity", "O(n)"),
        ("4.3.1/laws-complexity", "O(1)"), ("4.3.1/filters-complexity", "O(n)")],
    "5.4.1": [
        ("F1-position", "(0, 0)"), ("F1-axes", "(6, 2)"), ("F1-speed", "25"), ("F1-heading", "45"),
        ("F2-position", "(45, 0)"), ("F2-speed", "20"), ("F2-heading", "120"), ("y-0", "-0.0452"), ("saturation", "15"),
        ("out-of-F2", "0.80"), ("constant", "2.12"), ("passes-F2", "2.13"), ("F3-appears", "2.13"), ("F3-position", "(5, 75)"),
        ("F3-heading", "0"), ("y-2.13", "-0.06"), ("psi-2.13", "36.91"), ("F3-axes", "(6, 2)"), ("F3-k", "0.9"),
        ("out-of-F3", "2.70"), ("passes-F3", "3.74"), ("aligned", "4.88")],
    "5.4.2": [
        ("5.4.2/k", "|sin(2 t + pi/2)|"), ("F2-axes", "(6, 2)"), ("F2-k", "1"), ("F2-speed", "20"),
        ("F2-heading", "120"), ("y-0", "-0.053"), ("out-of-F2", "0.84"),
        ("degenerate", "full ellipse")],
    "6.3.1": [("engagements", "10,000"), ("engagements", "360"), ("bound", "2/n"), ("decreases", "decreases rapidly"),
              ("few-planes", "relatively small error")],
    "6.5": [
        ("noncooperative/A-position", "(10, 0, 0)"), ("noncooperative/A-axes", "(10, 5, 3)"),
        ("noncooperative/A-speed", "8.5"), ("noncooperative/A-heading", "(0, 69)"),
        ("noncooperative/B-position", "(0, 0, 20)"), ("noncooperative/B-axes", "(10, 5, 3)"),
        ("noncooperative/B-speed", "5"), ("noncooperative/B-heading", "(0, 0)"), ("noncooperative/y-0", "negative"),
        ("noncooperative/V_r-0", "negative"), ("noncooperative/plane", "maximum psi"),
        ("noncooperative/signs-B", "greater than zero"), ("noncooperative/clear-of-B", "4.7"),
        ("noncooperative/C-position", "(50, 15, 30)"), ("noncooperative/C-appears", "4.7"),
        ("noncooperative/C-speed", "5.1"), ("noncooperative/C-heading", "(0, 34.5)"),
        ("noncooperative/course-C", "collision course"), ("noncooperative/shape-C", "biconcave"), ("noncooperative/done-C", "8"),
        ("noncooperative/avoids-C", "out of the cone"),
        ("noncooperative/D-appears", "8"), ("noncooperative/D-position", "(95, -5, 40)"),
        ("noncooperative/D-speed", "3.61"), ("noncooperative/D-heading", "(5, 28)"),
        ("noncooperative/avoids-D", "out of the cone"), ("noncooperative/shape-D", "ellipsoid"),
        ("noncooperative/done-D", "10.5"), ("noncooperative/E-appears", "10.5"),
        ("noncooperative/faces", "10"), ("noncooperative/E-position", "(110, 30, 40)"),
        ("noncooperative/E-speed", "5.1"), ("noncooperative/E-heading", "(0, 34.5)"),
        ("noncooperative/avoids-E", "cleared"), ("/cooperative/course-B1", "collision course"),
        ("/cooperative/mu", "-0.5"), ("/cooperative/clear-of-B1", "5.5"), ("/cooperative/shape-B2", "biconcave"),
        ("6.5-cooperative/B2-appears", "5.5"),
        ("6.5-cooperative/B2-position", "(60, 15, 40)"), ("6.5-cooperative/B2-speed", "5.1"),
        ("6.5-cooperative/B2-heading", "(0, 34.5)"), ("/cooperative/course-B2", "collision course"),
        ("/cooperative/clear-of-B2", "11")],
    "7.2": [
        ("A-axes", "(6, 2)"), ("A-position", "(0, 0)"), ("noise-r", "20"), ("noise-theta", "3"), ("noise-V_r", "40"),
        ("noise-V_theta", "40"), ("noise-psi", "1"), ("noise-theta_b", "1"), ("7.2/deviation", "0.3333"), ("B-position", "(45, 0)"),
        ("B-heading", "120"), ("A-heading", "45"), ("passes-B", "2.33"), ("C-position", "(-7, 75)"), ("C-heading", "0"),
        ("course-C", "y < 0, V_r < 0"), ("out-of-C", "3.54"), ("out-of-D", "4.35"), ("goal-x", "80"), ("goal-y", "100"),
        ("7.2/goal", "5.67"), ("gamma-between", "undefined"), ("gamma-turn", "undefined"), ("out-of-B", "2"),
        ("D-appears", "4"), ("7.2/start", "negative"), ("7.2/tandem", "tandem"), ("7.2/gamma-active", "active role"), ("7.2/norm", "first two instants"), ("within-3-sigma", "high percentage")],
    "7.5": [
        ("A-speed", "8.5"), ("A-position", "(14, 0, 0)"), ("B-speed", "5"), ("B-position", "(0, 3, 20)"), ("7.5/r", "7.5"),
        ("7.5/s", "15"), ("7.5/deviation", "0.3333"), ("C-appears", "4.7"), ("C-speed", "5.1"), ("C-position", "(60, 12, 30)"),
        ("course-C", "on course"), ("avoids-B", "avoids"), ("avoids-C", "avoids"), ("estimate", "quite close"),
        ("7.5/tandem-C", "tandem"), ("7.18/trials", "1000"), ("7.18/5-di", "fails"), ("7.18/5-filter", "improves"), ("7.18/5-rdi", "100"), ("7.18/7.5-filter", "fails for all"),
        ("7.18/7.5-rdi-filter", "100"), ("7.18/7.5-rdi", "good"), ("7.18/10-rdi", "80"), ("7.18/10-down", "go down"), ("7.18/10-best", "outperforms"),
        ("7.18/always-best", "all these cases")],
}
