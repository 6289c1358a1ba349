MODULE endlessMove
  ! The program fails while the arm makes a move of hours: what comes after the end of the run is
  ! no part of it.
  VAR socketdev never_created;
  PROC main()
    MoveL [[735,-80,601],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[0.01,500,5000,1000],z30,tool0;
    SocketListen never_created;
  ENDPROC
ENDMODULE
