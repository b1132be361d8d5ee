# SPDX-License-Identifier: MIT
"""Code shared by the programs that drive robots along a passing order (grove toio, grove vda5050)."""
