# SPDX-License-Identifier: BSD-3-Clause
"""The one exception of the library."""
from __future__ import annotations


class InputError(ValueError):
    """An input that no answer exists for: "FIELD: got VALUE, must be REQUIREMENT".

    Of many questions at once the field has the index: `relative_velocity[123456][1]`.
    """

    __module__ = "vericone"

    def __init__(self, field: str, value: str, requirement: str) -> None:
        super().__init__(f"{field}: got {value}, must be {requirement}")
        self.field = field
        self.value = value
        self.requirement = requirement

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str]]:
        return InputError, (self.field, self.value, self.requirement)
