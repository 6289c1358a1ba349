! RAPID Kernel, TEST: cases list values of the type of the test data; there are no ranges.
MODULE test_wrong
  VAR num n;
  VAR clock watch;

  PROC main()
    TEST n
    CASE 1 TO 5:                      ! error: E144
      n:=1;
    CASE "6":                         ! error: T301
      n:=2;
    ENDTEST
    TEST watch                        ! error: T318
    CASE 1:
      n:=3;
    ENDTEST
  ENDPROC
ENDMODULE
