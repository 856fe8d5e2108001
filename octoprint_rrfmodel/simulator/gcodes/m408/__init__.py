"""M408: status replies of the time before the object model."""
