! RAPID Kernel, GOTO: to a label of the same or an enclosing statement list.
MODULE goto_statement
  VAR num n;

  PROC main()
    again:
    n:=n+1;
    IF n<3 GOTO again;
    TPWrite "n is "\Num:=n;           ! -> n is 3
    FOR i FROM 1 TO 10 DO
      IF i=2 GOTO done;
      TPWrite "turn "\Num:=i;         ! -> turn 1
    ENDFOR
    TPWrite "never";
    done:
    last: TPWrite "done";             ! -> done
  ENDPROC
ENDMODULE
