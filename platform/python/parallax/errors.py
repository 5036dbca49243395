# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, by who has to mend it."""


class Error(Exception):
    """A fault of the model, of the program or of this computer; base of the others."""


class UserError(Error, ValueError):
    """An unknown key, a bad value, an image that does not fit, ...: the line that the program prints, which says what, where,
    the value seen, and what would be right."""


class UnknownKey(UserError, KeyError):
    """Something is asked for by a name that there is not."""

    __str__ = Exception.__str__  # not in quotes, as a KeyError's


class Deadlock(Error):
    """The machine came to a halt before the host had all frames. The text is the program's: who waits for what, and what
    would free it. `run` holds what was measured until then."""

    def __init__(self, text, run=None):
        super().__init__(text)
        self.run = run

    def __reduce__(self):
        return type(self), (self.args[0], self.run)
