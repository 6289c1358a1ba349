! RAPID Kernel, Identifiers: a letter, then letters, digits and underscores; 32 at most.
MODULE identifiers
  VAR num x_1:=1;
  VAR num Größe:=2;
  VAR num a2345678901234567890123456789012:=3;
  VAR num a23456789012345678901234567890123:=4;  ! error: E108
ENDMODULE
