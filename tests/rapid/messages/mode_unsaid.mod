! Field practice, message queues that nobody describes: both modes work, and the run says so once.
MODULE mode_unsaid
  VAR rmqslot here;
  VAR rmqmessage message;
  VAR pose place:=[[1,2,3],[1,0,0,0]];
  VAR pose back;
  PROC main()
    RMQFindSlot here,"RMQ_"+GetTaskName();
    RMQSendMessage here,place;
    RMQReadWait message;  ! warning: R104
    RMQGetMsgData message,back;
    TPWrite ValToStr(back);  ! -> [[1,2,3],[1,0,0,0]]
  ENDPROC
ENDMODULE
