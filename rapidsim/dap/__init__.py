"""The debug adapter: a run under the Debug Adapter Protocol, forwards and backwards."""
