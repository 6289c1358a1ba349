! RAPID Kernel, TEST: values of any type with values; the first case that fits, and only that.
MODULE test_statement
  PROC main()
    FOR i FROM 1 TO 5 DO
      what i;
    ENDFOR
    TEST "b"
    CASE "a":
      TPWrite "first";
    CASE "b":
      TPWrite "second";             ! -> second
    ENDTEST
    TEST 1=1
    CASE TRUE:
      TPWrite "equal";              ! -> equal
    ENDTEST
    TEST 1
    DEFAULT:
      TPWrite "no case at all";     ! -> no case at all
    ENDTEST
    TEST 9
    CASE 1:
      TPWrite "never";
    ENDTEST
  ENDPROC

  PROC what(num n)
    TEST n
    CASE 1,2:
      TPWrite "one or two";
      ! -> one or two
      ! -> one or two
    CASE 2,3:
      TPWrite "three";              ! -> three
    CASE 2+2:
    DEFAULT:
      TPWrite "other";              ! -> other
    ENDTEST
  ENDPROC
ENDMODULE
