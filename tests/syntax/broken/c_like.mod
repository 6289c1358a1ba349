MODULE c_like
  PROC main() {
    x := 1;
    if (x == 1) {
      Stop();
    }
    else x := 2;
    for (i = 0; i < 3; i++) {
      a[i] = 0;
    }
    Reset do1;
  ENDPROC
ENDMODULE
