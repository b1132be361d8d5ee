# SPDX-License-Identifier: MIT
"""What programs that drive robots along a passing order share."""
