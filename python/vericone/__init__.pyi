# SPDX-License-Identifier: BSD-3-Clause
from vericone._errors import InputError as InputError
from vericone._root import *
