"""Pictures: one file a kind. They do not depend on the user's settings of matplotlib."""

from bikestab.plot.settings import import_matplotlib

import_matplotlib()
