"""One task's part of the virtual controller, one file a concern; `VirtualController` joins them."""
