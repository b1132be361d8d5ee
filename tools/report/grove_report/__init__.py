# SPDX-License-Identifier: MIT
"""Makes figures, tables and one page from the rows of `grove bench` and from logs of runs.

rows        reads and checks results
logs        reads logs of single runs
groups      groups items by a key
lines       lines of a figure: method, omega, time limit
metrics     success, runtime, SQR, PAR-2, ... of a set of rows
anytime     quality over time
speedup     times of the baselines over times of the other methods
proofs      contradictory claims, and false claims of other solvers
plans       reads plans of classical MAPF
tracker     MAPF Tracker: writes rows, reads best known costs and bounds
style       colours and markers
figures     plots that compare methods (only figures and curves need matplotlib)
curves      plots one column wide: success over agents, quality over time, single runs
tables      tables as CSV and as HTML
report      tables and figures of a report
page        the HTML page
cli         the command line
"""
