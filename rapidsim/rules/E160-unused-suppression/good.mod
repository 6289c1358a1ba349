MODULE example
  PROC main()
    WaitTime 1/0; ! rapidsim: ignore[T309] shows what ERR_DIVZERO looks like
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! rapidsim: ignore-file[T309] the divisions are tests
  PROC main()
    ! rapidsim: ignore[F402] switched by hand
    ! for the first run
    IF FALSE THEN
      WaitTime 1/0;
    ENDIF
    WaitTime 2/0; ! rapidsim: ignore
  ENDPROC
ENDMODULE
