MODULE example
  PROC main()
    VAR robtarget p10;
    MoveJ p10,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR pos place;
  LOCAL VAR num sizes{3};
  PROC main()
    VAR robtarget p10;
    VAR bool ready;
    MoveJ p10,v500,fine,tool0;        ! found
    IF ready TPErase;                 ! found
    WaitTime sizes{2};                ! found
    WaitTime place.x;                 ! found
    WaitTime place.y;
  ENDPROC
ENDMODULE
