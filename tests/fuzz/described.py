"""Requests that Schemathesis makes of the OpenAPI description, right ones and wrong ones."""

import schemathesis
from hypothesis import strategies as st
from schemathesis import GenerationMode


def cases(server):
    """Return the strategy of cases of every operation."""
    loaded = schemathesis.openapi.from_dict(server.get("/plugin/rrfmodel/openapi.json").json())
    loaded.config.update(base_url=server.url)
    loaded.config.generation.update(modes=[GenerationMode.POSITIVE, GenerationMode.NEGATIVE])
    operations = [found.ok() for found in loaded.get_all_operations()]
    return st.one_of(
        [
            operation.as_strategy(generation_mode=mode)
            for operation in operations
            for mode in (GenerationMode.POSITIVE, GenerationMode.NEGATIVE)
        ]
    )
