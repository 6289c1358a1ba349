! RAPID Overview, UNDO: EXIT in an ERROR clause ends the routines, and what they began is undone.
MODULE exit_in_a_clause
  VAR num zero;

  PROC main()
    divide;                                  ! ends: stopped
    TPWrite "never";
  UNDO
    TPWrite "main undone";                   ! -> main undone
  ENDPROC

  PROC divide()
    zero:=1/zero;
  ERROR
    TPWrite "given up";                      ! -> given up
    EXIT;                                    ! note: R107
  UNDO
    TPWrite "divide undone";                 ! -> divide undone
  ENDPROC
ENDMODULE
