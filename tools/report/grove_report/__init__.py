# SPDX-License-Identifier: MIT
"""From the rows of `grove bench` to figures, tables and one page.

rows        reading results, and what is wrong with them
groups      what has something in common
lines       what gets a line of its own in a figure: method, omega, time limit
metrics     success, runtime, SQR, PAR-2, ... of a set of rows
speedup     times of the baselines over those of the other methods
proofs      claims that contradict each other
style       colours and markers
figures     the plots (the only module that needs matplotlib)
tables      a table as CSV and as HTML
report      what the tables and figures of a report are
page        the HTML page
cli         the command line
"""
