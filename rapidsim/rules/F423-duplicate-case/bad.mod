MODULE example
  PROC main()
    TEST reg1
    CASE 1,2:
      TPWrite "left";
    CASE 2: ! found
      TPWrite "right";
    ENDTEST
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST num SMALL:=1;
  CONST string NAME:="A";
  VAR string kind;
  PROC main()
    TEST reg1
    CASE SMALL:
      TPWrite "small";
    CASE 3-2: ! found
      TPWrite "one";
    DEFAULT:
    ENDTEST
    TEST kind
    CASE NAME,"B":
    CASE "A": ! found
    ENDTEST
  ENDPROC
ENDMODULE
