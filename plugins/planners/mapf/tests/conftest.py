"""Makes `mapf_instances` and `mapf_oracle` importable for the tests beside them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
