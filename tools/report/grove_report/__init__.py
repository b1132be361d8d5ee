# SPDX-License-Identifier: MIT
"""Turns the rows of `grove bench` and the logs of single runs into figures, tables and one HTML page.

rows        reads and checks results
logs        reads logs of single runs
groups      groups items by a key
lines       lines of figures and tables: method, omega, time limit
metrics     success, runtime, SQR, PAR-2, ... of a set of rows
anytime     quality over time
speedup     ratios of the baselines' times to the times of the other methods
proofs      contradictory claims, and false claims of other solvers
plans       reads plans of classical MAPF
tracker     MAPF Tracker: writes rows, reads best known costs and bounds
style       colours and markers
figures     plots that compare methods (only figures and curves need matplotlib)
curves      plots one column wide: success over agents, quality over time, single runs, sources of their bounds
tables      tables as CSV and as HTML
report      builds all tables and figures of a report
page        the HTML page
cli         the command line
"""
