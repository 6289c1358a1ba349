! RAPID Kernel, Numeric literals: a num is single precision and ends near 3.4E38.
MODULE number_range
  VAR num large:=3E38;
  VAR num larger:=1E39;         ! error: T324
  VAR dnum largest:=1E39;
ENDMODULE
