! RAPID Overview, UNDO: a routine that ends by itself, or by RETURN, undoes nothing.
MODULE undo_not_by_return
  PROC main()
    plain;
    early;
    caught;
    TPWrite "end";                      ! -> end
  ENDPROC

  PROC plain()
    TPWrite "plain";                    ! -> plain
  UNDO
    TPWrite "never";
  ENDPROC

  PROC early()
    RETURN;
  UNDO
    TPWrite "never";
  ENDPROC

  PROC caught()
    RAISE 1;
  ERROR
    TRYNEXT;
  UNDO
    TPWrite "never";
  ENDPROC
ENDMODULE
