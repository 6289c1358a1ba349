"""What all tests share: property tests that find the same cases in every run."""

import os

from hypothesis import settings

# No deadline: machines differ. Derandomised: a run in CI must not fail for luck. To look for new
# cases, HYPOTHESIS_PROFILE=explore.
settings.register_profile("ci", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=500)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))
