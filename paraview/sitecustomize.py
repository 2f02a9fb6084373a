"""Lets ParaView 5.11 and earlier load Python plugins with Python 3.11 and later.

They import ``inspect.getargspec``, which Python 3.11 has no more. Python runs a file of this
name when it starts, if it is on the PYTHONPATH.
"""

import inspect

if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec
